#pragma once

#include <gnomon/image/Image.h>

#include <cstdint>
#include <optional>

namespace gnomon::client {

/// How much a factor changes from frame to frame where the truth does not.
struct FlickerError {
    std::uint64_t counted = 0;  ///< pixels whose truth stayed, over all pairs of frames
    std::uint64_t flipped = 0;  ///< of them, those that went to the other side of 127.5
    double meanChange = 0.0;    ///< of the factor over the counted ones, 0 to 1

    double share() const noexcept {
        return counted == 0 ? 0.0 : static_cast<double>(flipped) / static_cast<double>(counted);
    }
};

/// Takes factor images along a path, and tells what flickers. A pixel is counted where both frames'
/// truths have a surface that faces the light (not 128), are on one side of 127.5, and differ by at
/// most truthStays.
class Flicker {
public:
    /// Of 255: sampled truths of lights with an extent differ a little though nothing happened.
    static constexpr int truthStays = 4;

    /// @pre Both of one channel and one size, the same in every call.
    void add(const image::Image& truth, const image::Image& factor);
    FlickerError found() const noexcept;

private:
    struct Frame {
        image::Image truth = {};
        image::Image factor = {};
    };
    std::optional<Frame> last_ = {};
    FlickerError sum_ = {};
    std::uint64_t change_ = 0;  // of 255
};

}  // namespace gnomon::client
