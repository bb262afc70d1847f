#include "program/Confine.h"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>

#include <cerrno>
#include <cstdint>
#include <initializer_list>
#include <memory>

#include "format/Sanitizer.h"

namespace gnomon::importer {
namespace {

struct Release {
    void operator()(void* filter) const noexcept { seccomp_release(filter); }
};

constexpr std::uint32_t forbidden = SCMP_ACT_ERRNO(EPERM);
/// As on an older kernel: libraries then do it in the older way, which is looked at.
constexpr std::uint32_t unknown = SCMP_ACT_ERRNO(ENOSYS);

/// System calls without any good use here.
constexpr int useless[]{SCMP_SYS(execve),
                        SCMP_SYS(execveat),
                        SCMP_SYS(fork),
                        SCMP_SYS(vfork),
                        SCMP_SYS(socket),
                        SCMP_SYS(socketpair),
                        SCMP_SYS(connect),
                        SCMP_SYS(bind),
                        SCMP_SYS(ptrace),
                        SCMP_SYS(kill),
                        SCMP_SYS(process_vm_readv),
                        SCMP_SYS(process_vm_writev),
                        SCMP_SYS(creat),
                        SCMP_SYS(truncate),
                        SCMP_SYS(unlink),
                        SCMP_SYS(unlinkat),
                        SCMP_SYS(rmdir),
                        SCMP_SYS(rename),
                        SCMP_SYS(renameat),
                        SCMP_SYS(renameat2),
                        SCMP_SYS(link),
                        SCMP_SYS(linkat),
                        SCMP_SYS(symlink),
                        SCMP_SYS(symlinkat),
                        SCMP_SYS(mkdir),
                        SCMP_SYS(mkdirat),
                        SCMP_SYS(mknod),
                        SCMP_SYS(mknodat),
                        SCMP_SYS(chmod),
                        SCMP_SYS(fchmodat),
                        SCMP_SYS(chown),
                        SCMP_SYS(lchown),
                        SCMP_SYS(fchownat),
                        SCMP_SYS(setxattr),
                        SCMP_SYS(lsetxattr),
                        SCMP_SYS(mount),
                        SCMP_SYS(chroot),
                        SCMP_SYS(unshare),
                        SCMP_SYS(setns),
                        SCMP_SYS(bpf),
                        SCMP_SYS(perf_event_open)};

/// Argument @p which, of which only the bits of @p mask count, is @p value.
constexpr scmp_arg_cmp argument(unsigned which, scmp_datum_t mask, scmp_datum_t value) {
    return {.arg = which, .op = SCMP_CMP_MASKED_EQ, .datum_a = mask, .datum_b = value};
}

}  // namespace

bool confineProcess() {
    if (reservesAddressSpace) return false;  // the leak check clones and traces
    const std::unique_ptr<void, Release> filter{seccomp_init(SCMP_ACT_ALLOW)};
    if (!filter) return false;
    bool made = true;
    const auto rule = [&](std::uint32_t action, int call, auto... conditions) {
        made = made && seccomp_rule_add(filter.get(), action, call, sizeof...(conditions),
                                        conditions...) == 0;
    };
    for (const int call : useless) rule(forbidden, call);
    for (const int call : {SCMP_SYS(clone3), SCMP_SYS(openat2), SCMP_SYS(io_uring_setup)})
        rule(unknown, call);
    // Threads may be; processes may not.
    rule(forbidden, SCMP_SYS(clone), argument(0, CLONE_THREAD, 0));
    for (const int mode : {O_WRONLY, O_RDWR}) {
        const auto to = static_cast<scmp_datum_t>(mode);
        rule(forbidden, SCMP_SYS(open), argument(1, O_ACCMODE, to));
        rule(forbidden, SCMP_SYS(openat), argument(2, O_ACCMODE, to));
    }
    return made && seccomp_load(filter.get()) == 0;
}

}  // namespace gnomon::importer
