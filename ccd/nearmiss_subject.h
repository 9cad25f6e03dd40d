/* The plug-in interface of nearmiss: a shared object that exports nearmiss_get_subject() puts any continuous
 * collision detector on trial. C99; this header is the whole interface. */
#ifndef NEARMISS_SUBJECT_H
#define NEARMISS_SUBJECT_H

#ifdef __cplusplus
extern "C" {
#endif

#define NEARMISS_SUBJECT_ABI 1

typedef struct {
  int abi; /* NEARMISS_SUBJECT_ABI */
  const char *name, *version;
  /* x: 24 finite doubles, x0 x1 x2 x3 at t = 0, then at t = 1; x, y, z of each. The vertices move linearly.
   * The answer must depend on x alone: a query that fails is asked again, when it is shrunk and when it is replayed.
   * vertex_triangle: vertex x0, triangle x1 x2 x3. edge_edge: edges x0x1 and x2x3.
   * Returns 1 for a collision within [0, 1], 0 for none, a negative number for an error. *toi is the time of
   * a collision; it is NaN on entry and may stay so. Several threads may call at once. Arithmetic rounds to
   * nearest, keeps subnormals and does not trap; if a plug-in changes that, it is restored after the call. */
  int (*vertex_triangle)(const double* x, double* toi);
  int (*edge_edge)(const double* x, double* toi);
  /* The largest distance of a false positive that the plug-in claims; NULL if it claims no bound. */
  double (*distance_bound)(const double* x, int is_edge_edge);
} nearmiss_subject;

/* The one exported function. The object it points to stays valid until the plug-in is unloaded. */
const nearmiss_subject* nearmiss_get_subject(void);

#ifdef __cplusplus
}
#endif

#endif
