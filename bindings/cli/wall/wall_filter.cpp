// System calls that are refused, by a filter of the system (seccomp).
#include <stdexcept>

#include "bindings/cli/wall/wall_steps.h"

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace lissom::cli {
namespace {

#ifdef __x86_64__
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#endif

// Numbers from this one on are those of x32, another interface to the same calls.
constexpr std::uint32_t kOtherInterface = 0x40000000;
constexpr std::uint32_t kThread = 0x10000;                       // CLONE_THREAD
constexpr std::uint32_t kPushInput = 0x5412, kConsole = 0x541C;  // TIOCSTI, TIOCLINUX

// Network; programs and processes; debuggers; the system; other users; rights and places of files.
constexpr long kRefused[] = {
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_accept,
    SYS_accept4,
    SYS_sendto,
    SYS_sendmsg,
    SYS_sendmmsg,
    SYS_execve,
    SYS_execveat,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_kcmp,
    SYS_tkill,
    SYS_setsid,
    SYS_setpgid,
    SYS_unshare,
    SYS_setns,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_seccomp,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_kexec_load,
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_reboot,
    SYS_swapon,
    SYS_swapoff,
    SYS_syslog,
    SYS_acct,
    SYS_quotactl,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_adjtimex,
    SYS_sethostname,
    SYS_setdomainname,
    SYS_personality,
    SYS_setuid,
    SYS_setgid,
    SYS_setreuid,
    SYS_setregid,
    SYS_setresuid,
    SYS_setresgid,
    SYS_setgroups,
    SYS_setfsuid,
    SYS_setfsgid,
    SYS_capset,
    SYS_setrlimit,
    SYS_setpriority,
    SYS_sched_setscheduler,
    SYS_sched_setparam,
    SYS_mq_open,
    SYS_msgget,
    SYS_shmget,
    SYS_semget,
    SYS_fanotify_init,
    SYS_inotify_init1,
    SYS_open_by_handle_at,
    SYS_name_to_handle_at,
    SYS_setxattr,
    SYS_fsetxattr,
    SYS_lsetxattr,
    SYS_fchown,
    SYS_fchownat,
    SYS_mknodat,
    SYS_fchmodat,
    SYS_utimensat,
// Calls that newer systems or one of the machines have.
#ifdef SYS_fork
    SYS_fork,
    SYS_vfork,
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_mknod,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
    SYS_iopl,
    SYS_ioperm,
    SYS_modify_ldt,
#endif
#ifdef SYS_kexec_file_load
    SYS_kexec_file_load,
#endif
#ifdef SYS_io_uring_setup
    SYS_io_uring_setup,
    SYS_io_uring_enter,
    SYS_io_uring_register,
#endif
#ifdef SYS_pidfd_open
    SYS_pidfd_open,
    SYS_pidfd_send_signal,
#endif
#ifdef SYS_pidfd_getfd
    SYS_pidfd_getfd,
#endif
#ifdef SYS_process_madvise
    SYS_process_madvise,
#endif
#ifdef SYS_fsopen
    SYS_fsopen,
    SYS_fsmount,
    SYS_open_tree,
    SYS_move_mount,
#endif
#ifdef SYS_mount_setattr
    SYS_mount_setattr,
#endif
};

// A filter of system calls, instruction by instruction. Jumps skip the given number of them.
class Filter {
  public:
    static constexpr std::uint32_t kCall = offsetof(seccomp_data, nr);

    void load(std::size_t offset) {
        add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
    }
    // The lower or upper half of an argument.
    void load_argument(int i, int half = 0) {
        load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(i) +
             4 * static_cast<std::size_t>(half));
    }
    void if_equal(std::uint32_t value, std::uint8_t then, std::uint8_t otherwise) {
        add(BPF_JMP | BPF_JEQ | BPF_K, value, then, otherwise);
    }
    void if_not_below(std::uint32_t value, std::uint8_t then, std::uint8_t otherwise) {
        add(BPF_JMP | BPF_JGE | BPF_K, value, then, otherwise);
    }
    void if_any_bit(std::uint32_t bits, std::uint8_t then, std::uint8_t otherwise) {
        add(BPF_JMP | BPF_JSET | BPF_K, bits, then, otherwise);
    }
    void allow() { add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW); }
    void refuse(int error = EPERM) {
        add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error));
    }
    void kill() { add(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS); }

    // Returns whether all threads of the process have it.
    bool apply() {
        sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
        return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) ==
               0;
    }

  private:
    void add(unsigned code, std::uint32_t value, std::uint8_t then = 0,
             std::uint8_t otherwise = 0) {
        code_.push_back({static_cast<std::uint16_t>(code), then, otherwise, value});
    }

    std::vector<sock_filter> code_;
};

// Threads may begin, processes not. The newer call keeps its flags out of the filter's sight: the
// C library takes the older one if it is not there.
void allow_threads_only(Filter& filter) {
    filter.if_equal(SYS_clone3, 0, 1);
    filter.refuse(ENOSYS);
    filter.if_equal(SYS_clone, 0, 4);
    filter.load_argument(0);
    filter.if_any_bit(kThread, 0, 1);
    filter.allow();
    filter.refuse();
}

// Limits may be read: without new ones.
void allow_reading_limits(Filter& filter) {
    filter.if_equal(SYS_prlimit64, 0, 6);
    filter.load_argument(2);
    filter.if_equal(0, 0, 3);
    filter.load_argument(2, 1);
    filter.if_equal(0, 0, 1);
    filter.allow();
    filter.refuse();
}

void allow_signals_to_itself(Filter& filter, std::uint32_t process) {
    filter.if_equal(SYS_kill, 1, 0);
    filter.if_equal(SYS_tgkill, 0, 4);
    filter.load_argument(0);
    filter.if_equal(process, 0, 1);
    filter.allow();
    filter.refuse();
}

// No typing into the terminal of the user.
void refuse_typing(Filter& filter) {
    filter.if_equal(SYS_ioctl, 0, 5);
    filter.load_argument(1);
    filter.if_equal(kPushInput, 1, 0);
    filter.if_equal(kConsole, 0, 1);
    filter.refuse();
    filter.allow();
}

}  // namespace

bool can_filter_calls() {
    const std::uint32_t action = SECCOMP_RET_ERRNO;
    return syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

void filter_calls() {
    Filter filter;
    filter.load(offsetof(seccomp_data, arch));
    filter.if_equal(kMachine, 1, 0);
    filter.kill();
    filter.load(Filter::kCall);
    filter.if_not_below(kOtherInterface, 0, 1);
    filter.refuse(ENOSYS);
    allow_threads_only(filter);
    allow_reading_limits(filter);
    allow_signals_to_itself(filter, static_cast<std::uint32_t>(getpid()));
    refuse_typing(filter);
    for (const long call : kRefused) {
        filter.if_equal(static_cast<std::uint32_t>(call), 0, 1);
        filter.refuse();
    }
    filter.allow();
    if (!filter.apply()) {
        throw std::runtime_error(std::string("a filter of system calls: ") + std::strerror(errno));
    }
}

}  // namespace lissom::cli

#else

namespace lissom::cli {

bool can_filter_calls() {
    return false;
}

void filter_calls() {
    throw std::runtime_error("a filter of system calls: this system has none");
}

}  // namespace lissom::cli

#endif
