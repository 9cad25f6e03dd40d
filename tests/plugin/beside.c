/* A library that a plug-in finds in its own folder, by $ORIGIN. */
int beside(void);
int beside(void) { return 1; }
