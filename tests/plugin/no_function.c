/* A shared object that is not a plug-in. */
int nothing_of_interest(void) { return 0; }
