#pragma once

namespace gnomon::client {

/// While one lives, SIGINT and SIGTERM are noted instead of ending the program; a second signal, or
/// not getting to an end within five seconds, ends it at once. (Local servers end with us however
/// we end.) At most one at a time.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// A signal came.
    bool requested() const noexcept;
};

}  // namespace gnomon::client
