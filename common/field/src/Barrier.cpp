#include <gnomon/field/Barrier.h>

namespace gnomon::field {

void Barrier::enter(std::size_t count) {
    std::unique_lock lock{mutex_};
    const std::size_t meeting = meeting_;
    if (++inside_ >= count) {
        inside_ = 0;
        ++meeting_;
        met_.notify_all();
        return;
    }
    met_.wait(lock, [&] { return meeting_ != meeting; });
}

}  // namespace gnomon::field
