#pragma once

#include <sys/types.h>

#include <vector>

/// What /proc says about this machine's processes.
namespace gnomon::soak {

/// Resident memory, KiB; 0 where there is no such process.
long residentKib(pid_t pid);
int openFiles(pid_t pid);
/// Children of this process that ended and were not waited for.
int zombies();
/// Children of this process, ended or not.
std::vector<pid_t> children();

}  // namespace gnomon::soak
