/* Records the queries that a program asks its CCD, and the CCD's answers. C99 or C++, g++ or clang, POSIX.
 * After each call of the CCD, the program calls
 *
 *   nearmiss_record(NEARMISS_EDGE_EDGE, x, h, 1, answer, toi, 0);
 *
 * The records go to a file of a fixed size. When the file is full, the latest records replace the oldest:
 *
 *   NEARMISS_RECORD=run.nmq ./simulation                 $NEARMISS_RECORD_BYTES is the size; by default 64M
 *   nearmiss replay run.nmq --as-answered                judges the answers
 *
 * If the environment variable NEARMISS_RECORD is not set, a call costs about a nanosecond. If the variable is
 * set, any number of threads may record at once, and a forked child process records to the file of its
 * parent. If another process, or a shared object with a recorder of its own, already records to run.nmq, the
 * records go to a file whose name contains the number of this process: run-4711.nmq. If run.nmq is a finished
 * recording, it is first renamed to run.nmq~. If the program crashes, only the records that were being
 * written are lost. If the disk has no room for the file, a line on stderr says so, and nothing is
 * recorded. */
#ifndef NEARMISS_RECORD_H
#define NEARMISS_RECORD_H

#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE 1 /* for flock(2), posix_fallocate(3) with -std=c99, if this header comes first */
#endif
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <sched.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#ifndef O_CLOEXEC
#error "nearmiss_record.h: include it before all other headers, or compile with -std=gnu99 or later"
#endif

/* Kinds and answers, as in nearmiss_subject.h. */
#ifndef NEARMISS_VERTEX_TRIANGLE
#define NEARMISS_VERTEX_TRIANGLE 1 /* vertex x0, triangle x1 x2 x3 */
#define NEARMISS_EDGE_EDGE 2       /* edges x0x1 and x2x3 */
#define NEARMISS_VERTEX_VERTEX 4   /* vertices x0 and x1 */
#define NEARMISS_VERTEX_EDGE 8     /* vertex x0, edge x1x2 */
#endif
#ifndef NEARMISS_COLLISION
#define NEARMISS_NO_COLLISION 0
#define NEARMISS_COLLISION 1
#endif
#ifndef NEARMISS_UNKNOWN
#define NEARMISS_UNKNOWN 2 /* cannot tell */
#endif

/* A flag that keeps a record longer. The records with this flag fill a separate part of the file, so records
 * without the flag do not replace them. Set the flag for queries that matter, such as slow queries, queries
 * with a time of impact of 0, and the queries of a step that ends in an intersection. */
#define NEARMISS_KEEP 1

/* Values in the header of a recording. */
#define NEARMISS_RECORDING_MAGIC "NEARMISS"
#define NEARMISS_RECORDING_VERSION 1
#define NEARMISS_RECORDING_BYTE_ORDER 0x01020304

/* The header of a recording. In the file, the header is followed by `slots` records without the flag
 * NEARMISS_KEEP, then by `kept_slots` records with this flag. */
typedef struct {
  char magic[8];
  uint32_t version, byte_order;
  uint64_t slots, kept_slots;
  uint64_t unused[12];
  uint64_t next[8];      /* next[0]: the number of records so far, in both parts of the file */
  uint64_t next_slot[8]; /* next_slot[0]: the number of records so far in the first part */
  uint64_t next_kept[8]; /* next_kept[0]: the number of records so far in the second part */
  uint64_t rest[472];    /* makes the header 4096 bytes long */
} nearmiss_recording;

typedef struct {
  uint64_t number; /* 1 for the first record, 2 for the next, ...; 0 while the record is being written */
  uint32_t check;  /* nearmiss_record_check() */
  uint8_t kind, is_float, flags;
  int8_t answer;
  double separation, tmax, toi;
  double x[24];
  uint64_t unused[3];
} nearmiss_record_slot;

/* The recorder. All source files of the program share it, and so do all shared objects that can see the
 * symbol nearmiss_the_recorder. */
typedef struct {
  int state;  /* 0: not yet known; 1: off; 2: on; 3: a thread is opening the file */
  int opener; /* the process that opens the file, while `state` is 3 */
  nearmiss_recording* file;
} nearmiss_recorder;

#ifdef __cplusplus
extern "C" {
#endif
__attribute__((weak, visibility("default"))) nearmiss_recorder nearmiss_the_recorder = {0, 0, NULL};
#ifdef __cplusplus
}
#endif

/* A checksum of all bytes of a record except its fields `number`, `check` and `unused`. */
__attribute__((unused)) static uint32_t nearmiss_record_check(const nearmiss_record_slot* slot) {
  uint64_t words[28], sum = 0;
  size_t i;
  memcpy(words, (const char*)slot + offsetof(nearmiss_record_slot, check), sizeof words);
  words[0] &= ~(uint64_t)UINT32_MAX; /* clears `check`, in the byte order of x86 and ARM */
  for (i = 0; i < 28; ++i) sum = (sum << 7 | sum >> 57) ^ words[i];
  sum *= UINT64_C(0x9e3779b97f4a7c15);
  return (uint32_t)(sum >> 32);
}

/* Says on stderr why nothing is recorded. */
__attribute__((unused)) static int nearmiss_record_fails(const char* file, const char* why) {
  fprintf(stderr, "nearmiss_record: %s: %s; nothing is recorded\n", file, why);
  return 0;
}

/* Opens and locks a new file with the name `file`, and returns its descriptor. An earlier file with this name
 * is renamed to `file`~, unless a process uses the earlier file. Returns -1 after an error; errno is
 * EWOULDBLOCK if a process uses the earlier file. */
__attribute__((unused)) static int nearmiss_record_open(const char* file) {
  struct stat found, named;
  char earlier[4097];
  int fd, old, why;
  if (snprintf(earlier, sizeof earlier, "%s~", file) >= (int)sizeof earlier) {
    errno = ENAMETOOLONG;
    return -1;
  }
  if (stat(file, &named) == 0 && !S_ISREG(named.st_mode)) {
    errno = EINVAL; /* a device, a pipe or a folder */
    return -1;
  }
  fd = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd < 0) return -1;
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    close(fd);
    errno = EWOULDBLOCK;
    return -1;
  }
  if (fstat(fd, &found) != 0 || stat(file, &named) != 0 || found.st_ino != named.st_ino) {
    close(fd);
    errno = EWOULDBLOCK; /* another process has just replaced this file */
    return -1;
  }
  if (found.st_size == 0) return fd;
  old = fd; /* stays locked until the new file is locked */
  fd = rename(file, earlier) == 0 ? open(file, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
  why = errno == EEXIST ? EWOULDBLOCK : errno;
  if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) != 0) {
    close(fd);
    fd = -1;
    why = EWOULDBLOCK;
  }
  close(old);
  errno = why;
  return fd;
}

/* Opens a new file with the name `file`. If another process or shared object uses that file, opens instead a
 * new file whose name also contains the number of this process. Writes the name of the opened file to
 * `own`. */
__attribute__((unused)) static int nearmiss_record_open_own(const char* file, char* own, size_t size) {
  const char* dot = strrchr(file, '.');
  const size_t stem = dot == NULL || strchr(dot, '/') != NULL ? strlen(file) : (size_t)(dot - file);
  int fd, i;
  snprintf(own, size, "%s", file);
  fd = nearmiss_record_open(own);
  for (i = 1; fd < 0 && errno == EWOULDBLOCK && i < 100; ++i) {
    if (i == 1)
      snprintf(own, size, "%.*s-%ld%s", (int)stem, file, (long)getpid(), file + stem);
    else
      snprintf(own, size, "%.*s-%ld-%d%s", (int)stem, file, (long)getpid(), i, file + stem);
    fd = nearmiss_record_open(own);
  }
  return fd;
}

/* Whether this process may write a file of this size. The system may limit the size of a process's files, and
 * writing beyond this limit would raise a signal that ends the program. */
__attribute__((unused)) static int nearmiss_record_may_have(size_t size) {
  struct rlimit limit;
  return getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || size <= limit.rlim_cur;
}

/* Makes a file for `bytes` bytes of records, and maps it into memory. Returns 1 for success, else 0. */
__attribute__((unused)) static int nearmiss_record_map(const char* file, size_t bytes) {
  char own[4097];
  nearmiss_recording* head;
  void* memory;
  const size_t slots = bytes / sizeof(nearmiss_record_slot);
  const size_t size = sizeof(nearmiss_recording) + slots * sizeof(nearmiss_record_slot);
  int fd, error;
  if (file == NULL || file[0] == '\0') return 0;
  if (slots < 64 || bytes > (size_t)1 << 40)
    return nearmiss_record_fails(file, "the size is not between 16 KiB and 1 TiB");
  if (!nearmiss_record_may_have(size)) return nearmiss_record_fails(file, strerror(EFBIG));
  fd = nearmiss_record_open_own(file, own, sizeof own);
  if (fd < 0) return nearmiss_record_fails(own, errno == EINVAL ? "no regular file" : strerror(errno));
  error = posix_fallocate(fd, 0, (off_t)size); /* writing to a hole on a full disk would end the program */
  memory = error == 0 ? mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (memory == MAP_FAILED) {
    if (error == 0) error = errno;
    unlink(own); /* this process made the file, or found it empty */
    close(fd);
    return nearmiss_record_fails(own, strerror(error));
  }
  head = (nearmiss_recording*)memory;
  head->version = NEARMISS_RECORDING_VERSION;
  head->byte_order = NEARMISS_RECORDING_BYTE_ORDER;
  head->kept_slots = slots / 4;
  head->slots = slots - slots / 4;
  memcpy(head->magic, NEARMISS_RECORDING_MAGIC, sizeof head->magic);
  nearmiss_the_recorder.file = head; /* the file stays open, and locked, until the process ends */
  return 1;
}

/* Makes the recorder write to `file` from now on, whatever the environment variables say. If `file` is NULL,
 * the recorder stops, and the environment variables do not start it again. Returns 1 if queries are now
 * recorded, else 0. Call this function before other threads record. */
__attribute__((unused)) static int nearmiss_record_to(const char* file, size_t bytes) {
  int is_on;
  nearmiss_the_recorder.opener = (int)getpid();
  __atomic_store_n(&nearmiss_the_recorder.state, 3, __ATOMIC_RELEASE);
  is_on = nearmiss_record_map(file, bytes);
  __atomic_store_n(&nearmiss_the_recorder.state, is_on ? 2 : 1, __ATOMIC_RELEASE);
  return is_on;
}

/* Reads a number of bytes, such as 1000000, 64K, 64M or 1G. Returns `otherwise` if the text is NULL or empty,
 * and 0 if the text is not a number of bytes. */
__attribute__((unused)) static size_t nearmiss_record_bytes(const char* text, size_t otherwise) {
  unsigned long long number;
  char* end;
  int shift;
  if (text == NULL || text[0] == '\0') return otherwise;
  if (text[0] < '0' || text[0] > '9') return 0;
  errno = 0;
  number = strtoull(text, &end, 10);
  shift = *end == 'K' ? 10 : *end == 'M' ? 20 : *end == 'G' ? 30 : 0;
  if (shift != 0) ++end;
  return errno != 0 || *end != '\0' || number > SIZE_MAX >> shift ? 0 : (size_t)number << shift;
}

/* Starts recording if the environment asks for it. Only the first call has an effect. */
__attribute__((unused, noinline)) static void nearmiss_record_begin(void) {
  int asked = 0;
  nearmiss_the_recorder.opener = (int)getpid(); /* all threads that get here write the same number */
  if (!__atomic_compare_exchange_n(&nearmiss_the_recorder.state, &asked, 3, 0, __ATOMIC_ACQ_REL,
                                   __ATOMIC_ACQUIRE))
    return; /* another thread opens the file */
  nearmiss_record_to(getenv("NEARMISS_RECORD"),
                     nearmiss_record_bytes(getenv("NEARMISS_RECORD_BYTES"), (size_t)64 << 20));
}

/* Returns whether queries are recorded. The first call opens the file, and calls in other threads wait until
 * the file is open. A child process that is forked while the file is being opened records nothing. */
static inline int nearmiss_record_is_on(void) {
  int state = __atomic_load_n(&nearmiss_the_recorder.state, __ATOMIC_ACQUIRE);
  if (state == 0) nearmiss_record_begin();
  while (state == 0 || state == 3) {
    state = __atomic_load_n(&nearmiss_the_recorder.state, __ATOMIC_ACQUIRE);
    if (state != 3) continue;
    if (nearmiss_the_recorder.opener != (int)getpid()) return 0;
    sched_yield();
  }
  return state == 2;
}

/* Writes a record to the file, with its number and its checksum. */
__attribute__((unused, noinline)) static void nearmiss_record_write(nearmiss_record_slot* record) {
  nearmiss_recording* const file = nearmiss_the_recorder.file;
  nearmiss_record_slot* slot = (nearmiss_record_slot*)(file + 1);
  const uint64_t number = __atomic_add_fetch(&file->next[0], 1, __ATOMIC_RELAXED);
  if ((record->flags & NEARMISS_KEEP) != 0)
    slot += file->slots + __atomic_fetch_add(&file->next_kept[0], 1, __ATOMIC_RELAXED) % file->kept_slots;
  else
    slot += __atomic_fetch_add(&file->next_slot[0], 1, __ATOMIC_RELAXED) % file->slots;
  record->check = nearmiss_record_check(record);
  (void)__atomic_exchange_n(&slot->number, 0, __ATOMIC_ACQ_REL); /* before other bytes change */
  memcpy((char*)slot + sizeof slot->number, (const char*)record + sizeof record->number,
         sizeof *record - sizeof record->number);
  __atomic_store_n(&slot->number, number, __ATOMIC_RELEASE);
}

/* The number of coordinates of a query of this kind: 24, 18 or 12. */
__attribute__((unused)) static int nearmiss_record_size(int kind) {
  return kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
}

/* A record without coordinates. */
__attribute__((unused)) static nearmiss_record_slot nearmiss_record_of(int kind, double separation,
                                                                       double tmax, int answer, double toi,
                                                                       int flags) {
  nearmiss_record_slot record;
  memset(&record, 0, sizeof record);
  record.kind = (uint8_t)(kind < 0 || kind > UINT8_MAX ? 0 : kind);
  record.flags = (uint8_t)flags;
  record.answer = (int8_t)(answer < INT8_MIN || answer > INT8_MAX ? INT8_MIN : answer);
  record.separation = separation;
  record.tmax = tmax;
  record.toi = toi;
  return record;
}

/* Records one query and its answer.
 *   x: the coordinates x, y, z of x0 x1 .. at t = 0, then those at t = 1
 *   separation: the distance for which the CCD is asked; 0 for contact
 *   tmax: usually 1; the CCD is asked about t in [0, tmax]
 *   answer: NEARMISS_COLLISION and so on
 *   toi: the time of impact that the CCD gives; NAN if it gives none
 *   flags: 0 or NEARMISS_KEEP */
static inline void nearmiss_record(int kind, const double* x, double separation, double tmax, int answer,
                                   double toi, int flags) {
  nearmiss_record_slot record;
  if (!nearmiss_record_is_on()) return;
  record = nearmiss_record_of(kind, separation, tmax, answer, toi, flags);
  memcpy(record.x, x, sizeof(double) * (size_t)nearmiss_record_size(kind));
  nearmiss_record_write(&record);
}

/* nearmiss_record() for a CCD in float. The record has exactly the given numbers. */
static inline void nearmiss_record_float(int kind, const float* x, float separation, float tmax, int answer,
                                         float toi, int flags) {
  nearmiss_record_slot record;
  int i;
  if (!nearmiss_record_is_on()) return;
  record = nearmiss_record_of(kind, (double)separation, (double)tmax, answer, (double)toi, flags);
  record.is_float = 1;
  for (i = 0; i < nearmiss_record_size(kind); ++i) record.x[i] = (double)x[i];
  nearmiss_record_write(&record);
}

#endif
