/* A plug-in of another version of the interface. */
static const int interface_version = VERSION;
const int* nearmiss_get_subject(void) { return &interface_version; }
