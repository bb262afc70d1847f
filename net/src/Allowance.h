#pragma once

#include "Asio.h"

namespace gnomon::net {

/// So many a second.
class Allowance {
public:
    explicit Allowance(unsigned most) : most_{most} {}

    /// False where that many were taken in this second.
    bool take(TimePoint now) noexcept {
        if (now >= next()) {
            since_ = now;
            taken_ = 0;
        }
        if (taken_ >= most_) return false;
        ++taken_;
        return true;
    }
    /// When there are some again.
    TimePoint next() const noexcept { return since_ + std::chrono::seconds{1}; }

private:
    unsigned most_;
    unsigned taken_ = 0;
    TimePoint since_ = {};
};

}  // namespace gnomon::net
