/* A library that a plug-in finds beside it, by $ORIGIN. */
int beside(void);
int beside(void) { return 1; }
