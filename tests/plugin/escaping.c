/* A subject that tries something forbidden: to act on its supervisor, or on the process whose number is in
 * the environment variable NEARMISS_PROCESS. The subject makes its attempt at the first query with x > 0.9,
 * or while it is loaded. If the attempt fails, the subject reports the query. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/keyctl.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "tests/plugin/one_by_one.h"

static pid_t nearmiss(void) { return atoi(getenv("NEARMISS_PROCESS")); }

/* Leaves a process behind that is no longer a descendant of the supervisor's children. */
static void leave_one_behind(void) {
  if (fork() != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  while (1) pause();
}

#if defined(SIGNAL)
/* Tries every way of sending SIGUSR1. */
static int attempt(void) {
  const pid_t victim = nearmiss();
  siginfo_t how = {0};
  how.si_code = SI_QUEUE;
  int sent = kill(victim, SIGUSR1) == 0;
  sent += syscall(SYS_tkill, victim, SIGUSR1) == 0;
  sent += syscall(SYS_tgkill, victim, victim, SIGUSR1) == 0;
  sent += syscall(SYS_rt_sigqueueinfo, victim, SIGUSR1, &how) == 0;
  sent += syscall(SYS_rt_tgsigqueueinfo, victim, victim, SIGUSR1, &how) == 0;
  const int process = (int)syscall(SYS_pidfd_open, victim, 0);
  sent += syscall(SYS_pidfd_send_signal, process, SIGUSR1, NULL, 0) == 0;
  int ends[2];
  if (pipe(ends) != 0) return 0;
  fcntl(ends[0], F_SETSIG, SIGUSR1);
  sent += fcntl(ends[0], F_SETOWN, victim) == 0;
  fcntl(ends[0], F_SETFL, O_ASYNC | O_NONBLOCK);
  if (write(ends[1], "", 1) != 1) return 0;
  return sent == 0;
}
#elif defined(SCHEDULE)
/* Tries to slow nearmiss down. */
static int attempt(void) {
  const pid_t victim = nearmiss();
  const struct sched_param lowest = {0};
  cpu_set_t first;
  CPU_ZERO(&first);
  CPU_SET(0, &first);
  int done = sched_setscheduler(victim, SCHED_IDLE, &lowest) == 0;
  done += sched_setparam(victim, &lowest) == 0;
  done += sched_setaffinity(victim, sizeof first, &first) == 0;
  done += setpriority(PRIO_PROCESS, (id_t)victim, 19) == 0;
  done += setpriority(PRIO_PGRP, (id_t)getpgid(victim), 19) == 0;
  done += syscall(SYS_ioprio_set, 1, victim, 3 << 13) == 0;
  setpriority(PRIO_USER, 0, 19); /* changes only processes that it sees */
  for (int i = 0; i < 2; ++i) {
    char path[64];
    snprintf(path, sizeof path, "/proc/%d/%s", victim, i == 0 ? "autogroup" : "oom_score_adj");
    done += open(path, O_WRONLY) >= 0;
  }
  return done == 0;
}
#elif defined(TRACE)
static int may_trace(pid_t victim) {
  int done = 0;
  for (int i = 0; i < 2; ++i) {
    char path[64];
    snprintf(path, sizeof path, "/proc/%d/%s", victim, i == 0 ? "mem" : "environ");
    done += open(path, i == 0 ? O_RDWR : O_RDONLY) >= 0;
  }
  char* const address = (char*)strtoul(getenv("NEARMISS_ADDRESS"), NULL, 0);
  char changed = 1;
  const struct iovec ours = {&changed, 1}, theirs = {address, 1};
  done += process_vm_writev(victim, &ours, 1, &theirs, 1, 0) == 1;
  done += syscall(SYS_pidfd_getfd, syscall(SYS_pidfd_open, victim, 0), 1, 0) >= 0;
  done += ptrace(PTRACE_SEIZE, victim, NULL, NULL) == 0;
  return done;
}
static int attempt(void) { return !may_trace(nearmiss()) && !may_trace(getppid()); }
#elif defined(PRIVILEGES)
/* Looks at the capabilities that the process has. Only the first five, which concern files, may be left. */
static int attempt(void) {
  FILE* const status = fopen("/proc/self/status", "r");
  char line[256];
  int fine = 0;
  unsigned long set = 0;
  while (fgets(line, sizeof line, status) != NULL) {
    if (sscanf(line, "CapPrm: %lx", &set) == 1 || sscanf(line, "CapEff: %lx", &set) == 1) fine += set < 32;
    if (strncmp(line, "NoNewPrivs:\t1", 13) == 0) ++fine;
  }
  fclose(status);
  return fine == 3;
}
#elif defined(SHARED)
/* Leaves shared memory behind, and tries to take more than 1 GiB of it. */
static int attempt(void) {
  struct statvfs all;
  if (shmget(IPC_PRIVATE, 1 << 20, IPC_CREAT | 0600) < 0 || statvfs("/dev/shm", &all) != 0) return 0;
  const int file = shm_open("/nearmiss-left", O_CREAT | O_RDWR, 0600);
  return file >= 0 && posix_fallocate(file, 0, 1L << 31) == EFBIG && all.f_blocks * all.f_frsize == 1 << 30;
}
#elif defined(KEYRINGS)
static int attempt(void) {
  int done = syscall(SYS_add_key, "user", "nearmiss-left", "x", 1, KEY_SPEC_USER_KEYRING) >= 0;
  done += syscall(SYS_request_key, "user", "nearmiss", NULL, 0) >= 0 || errno != EPERM;
  done += syscall(SYS_keyctl, KEYCTL_GET_KEYRING_ID, KEY_SPEC_SESSION_KEYRING, 1) >= 0;
  return done == 0;
}
#elif defined(TERMINAL)
/* Tries to stop the output of a terminal, or to change its settings. */
static int attempt(void) {
  const int terminal = open(getenv("NEARMISS_TERMINAL"), O_RDWR | O_NOCTTY);
  struct termios settings = {0};
  return terminal < 0 || (tcflow(terminal, TCOOFF) != 0 && tcsetattr(terminal, TCSANOW, &settings) != 0);
}
#elif defined(LEAVE)
static int attempt(void) {
  int status = 0;
  const pid_t child = fork();
  if (child == 0) _exit(setpgid(0, 0) == 0 || setsid() >= 0);
  return waitpid(child, &status, 0) == child && status == 0;
}
#elif defined(NAMESPACE)
static int attempt(void) {
  return getppid() == 1 && kill(nearmiss(), 0) != 0 && errno == ESRCH && kill(1, SIGKILL) == 0;
}
#else
static int attempt(void) {
  leave_one_behind();
  prctl(PR_SET_PDEATHSIG, 0);
  kill(getppid(), HOW);
#if defined(GROUP)
  kill(0, HOW);
#endif
  return 1;
}
#endif

#if defined(WHILE_LOADED)
__attribute__((constructor)) static void begin(void) {
  attempt();
  while (1) pause();
}
#endif

static int answer(const double* x, double* toi) {
  static int result = -1;
  *toi = 0.5;
  if (x[0] <= 0.9) return 1;
  (void)nearmiss, (void)leave_one_behind;
  if (result < 0) result = attempt();
  return result;
}

EXPORT_DETECTOR("escaping", answer, NULL)
