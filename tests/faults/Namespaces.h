#pragma once

#include <string>
#include <vector>

namespace gnomon::faults {

/// A network namespace without a name: it goes when the last descriptor and process in it do, so
/// nothing is left of a test that is killed.
class Namespace {
public:
    /// With its loopback up. @throws Failure where this is not allowed
    Namespace();
    ~Namespace();
    Namespace(const Namespace&) = delete;
    Namespace& operator=(const Namespace&) = delete;

    int fd() const { return fd_; }
    /// A name of it that other programs can open.
    std::string path() const;

private:
    int fd_ = -1;
};

/// The calling thread, and what it starts, lives in the namespace as long as this does.
class Inside {
public:
    explicit Inside(const Namespace& where);
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

private:
    int before_ = -1;
};

/// Runs a program to its end where the thread is. @throws Failure if that is not well
void command(std::vector<std::string> words);

/// Why there can be no namespaces and TUN devices here; empty: there can.
std::string whyNoNamespaces();

}  // namespace gnomon::faults
