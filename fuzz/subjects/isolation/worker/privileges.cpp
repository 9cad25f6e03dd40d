#include "fuzz/subjects/isolation/worker/privileges.hpp"

#include <asm/ioctls.h>
#include <dirent.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <linux/sockios.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace nearmiss::isolation {

namespace {

constexpr int ioprio_who_process = 1;  // see ioprio_set(2); no header defines this constant

/// The machine (AUDIT_ARCH_...) of this program's system calls; 0 if the filter does not support this
/// machine.
#if defined(__x86_64__)
constexpr unsigned machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned machine = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned machine = 0;
#endif

/// A program that the kernel runs for each system call (seccomp(2)); a forbidden call fails with EPERM.
/// Before and after every rule, the program's accumulator has the number of the system call.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    jump(BPF_JEQ, machine, 1, 0);
    refuse();
    load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
    constexpr unsigned first_of_x32 = 0x40000000;
    jump(BPF_JGE, first_of_x32, 0, 1);
    refuse();
#endif
  }

  void forbid(int call) {
    jump_if_equal(call, 0, 1);
    refuse();
  }

  /// Forbids a system call if its argument with this number has this value.
  void forbid(int call, unsigned argument, int value) {
    jump_if_equal(call, 0, 4);
    load_argument(argument);
    jump_if_equal(value, 0, 1);
    refuse();
    load(offsetof(seccomp_data, nr));
  }

  /// Forbids a system call unless its argument with this number has one of two values.
  void limit(int call, unsigned argument, int value, int other) {
    jump_if_equal(call, 0, 5);
    load_argument(argument);
    jump_if_equal(value, 2, 0);
    jump_if_equal(other, 1, 0);
    refuse();
    load(offsetof(seccomp_data, nr));
  }

  void apply() {
    if (machine == 0) return;
    code_.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
  }

 private:
  void load(std::size_t offset) {
    code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset)));
  }
  /// Loads the lower half of an argument, because each argument that the filter tests has only 32 bits.
  /// x86-64 and AArch64 store the lower half first.
  void load_argument(unsigned i) { load(offsetof(seccomp_data, args) + i * sizeof(__u64)); }
  void jump(unsigned short test, unsigned value, unsigned char if_true, unsigned char if_false) {
    code_.push_back(BPF_JUMP(static_cast<unsigned short>(BPF_JMP | test | BPF_K), value, if_true, if_false));
  }
  void jump_if_equal(int value, unsigned char if_true, unsigned char if_false) {
    jump(BPF_JEQ, static_cast<unsigned>(value), if_true, if_false);
  }
  void refuse() { code_.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)); }

  std::vector<sock_filter> code_;
};

}  // namespace

void drop_privileges() {
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);  // programs that this process starts cannot gain privileges
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  if (syscall(SYS_capget, &header, sets.data()) != 0) return;
  unsigned of_files = 0;
  for (const int each : {CAP_CHOWN, CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, CAP_FOWNER, CAP_FSETID})
    of_files |= CAP_TO_MASK(each);
  for (auto& set : sets) {
    set.effective &= of_files;
    set.permitted &= of_files;
    set.inheritable = 0;
    of_files = 0;  // only the first element of `sets` has privileges on files
  }
  syscall(SYS_capset, &header, sets.data());
}

void keep_out_of_keyrings_and_terminals() {
  Filter filter;
  for (const int call : {SYS_add_key, SYS_request_key, SYS_keyctl}) filter.forbid(call);
  // The value of TCSETS2 on x86-64 and AArch64; TCSETSW2 and TCSETSF2 have the next two values. The header
  // that defines them conflicts with other headers.
  constexpr int set_other_speeds = 0x402c542b;
  for (const int command : {TCXONC, TCSETS, TCSETSW, TCSETSF, TCSETA, TCSETAW, TCSETAF, TIOCSTI,
                            set_other_speeds, set_other_speeds + 1, set_other_speeds + 2})
    filter.forbid(SYS_ioctl, 1, command);
  filter.apply();
}

void confine_to_itself() {
  const pid_t self = getpid();
  Filter filter;
  for (const int call : {SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_tkill, SYS_pidfd_open,
                         SYS_pidfd_getfd, SYS_pidfd_send_signal})
    filter.forbid(call);
  // Allows these calls only if their first argument is this process, or 0. The value 0 stands for the caller
  // or for the caller's group.
  for (const int call : {SYS_kill, SYS_tgkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_prlimit64,
                         SYS_sched_setscheduler, SYS_sched_setparam, SYS_sched_setattr, SYS_sched_setaffinity,
                         SYS_migrate_pages, SYS_move_pages})
    filter.limit(call, 0, self, 0);
  // Forbids these processes to change the priority of a group, a user or another process.
  filter.limit(SYS_setpriority, 0, PRIO_PROCESS, PRIO_PROCESS);
  filter.limit(SYS_ioprio_set, 0, ioprio_who_process, ioprio_who_process);
  for (const int call : {SYS_setpriority, SYS_ioprio_set}) filter.limit(call, 1, self, 0);
  // Forbids these processes to set the owner of an open file, because the owner gets signals, and the process
  // that sets the owner chooses which signals these are.
  for (const int command : {F_SETOWN, F_SETOWN_EX}) filter.forbid(SYS_fcntl, 1, command);
  for (const int command : {FIOSETOWN, SIOCSPGRP}) filter.forbid(SYS_ioctl, 1, command);
  // Keeps all processes that this process starts in its process group, so that one signal to the group
  // reaches all of them.
  for (const int call : {SYS_setsid, SYS_setpgid}) filter.forbid(call);
  filter.apply();
}

void keep_out_of_other_processes() {
  // Landlock refuses to move a file from one folder to another, as pocl does with compiled kernels, unless a
  // rule allows such moves. The first version of Landlock has no such rule.
  const bool can_allow_moves =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) > 1;
  const __u64 of_folders =
      LANDLOCK_ACCESS_FS_WRITE_FILE | (can_allow_moves ? LANDLOCK_ACCESS_FS_REFER : __u64{0});
  landlock_ruleset_attr wanted{};  // all other members are zero; newer kernels have more members
  wanted.handled_access_fs = of_folders;
  const auto rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &wanted, sizeof wanted, 0));
  if (rules < 0) return;
  DIR* const root = opendir("/");
  while (const dirent* entry = root == nullptr ? nullptr : readdir(root)) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == ".." || name == "proc") continue;
    const int parent = openat(dirfd(root), entry->d_name, O_PATH | O_CLOEXEC);
    // If the entry is a file, the system refuses a rule that allows moves, but accepts the second rule.
    for (const __u64 access : {of_folders, __u64{LANDLOCK_ACCESS_FS_WRITE_FILE}}) {
      const landlock_path_beneath_attr rule{.allowed_access = access, .parent_fd = parent};
      syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    }
    close(parent);
  }
  if (root != nullptr) closedir(root);
  syscall(SYS_landlock_restrict_self, rules, 0);
  close(rules);
}

}  // namespace nearmiss::isolation
