#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Program.h"

namespace gnomon::wall {

/// What starts servers on other machines: the real thing, set up for this machine alone and for as
/// long as the object lives, with files and ports of its own.
class Starter {
public:
    virtual ~Starter() = default;
    /// Sets it up. What is missing here, if it cannot be.
    virtual std::optional<std::string> begin(const Folder& folder) = 0;
    /// As in the wall's file: the name that servers' machines have, and lines of [cluster].
    virtual std::string host() const = 0;
    virtual std::string lines() const = 0;
    /// For gnomon.
    virtual std::vector<std::string> environment() const { return {}; }
};

std::unique_ptr<Starter> sshStarter();
std::unique_ptr<Starter> slurmStarter();
std::unique_ptr<Starter> mpiStarter();

/// Where that program is, looked for where daemons are, too; empty where it is not installed.
std::string installed(const std::string& program);
/// This machine's own name, as it resolves to an address of its own; empty where it does not.
std::string ownName();

}  // namespace gnomon::wall
