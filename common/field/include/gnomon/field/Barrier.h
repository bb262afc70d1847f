#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace gnomon::field {

/// Where threads meet, each with its aspect, to exchange change lists. As OpenSG's: the number of
/// threads is said at each meeting.
class Barrier {
public:
    /// Returns when @p count threads have entered. All of a meeting say the same count.
    void enter(std::size_t count);

private:
    std::mutex mutex_;
    std::condition_variable met_;
    std::size_t inside_ = 0;
    std::size_t meeting_ = 0;
};

}  // namespace gnomon::field
