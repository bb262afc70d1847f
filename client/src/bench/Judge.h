#pragma once

#include <filesystem>

#include "Contender.h"

namespace gnomon::client {

/// The truth about one view, also along paths, and who is how far from it.
class Judge {
public:
    /// @param flickerFrames  of each path; 0: flicker is not judged. @throws Failure
    Judge(Reference& reference, const BenchView& view, int flickerFrames, const CameraPath* path,
          Console& console);

    /// The light as a sun; nothing where there are several lights or another kind of light.
    std::optional<math::dvec3> onlySun() const;
    /// Fills in how wrong and how unsteady, and leaves the contender where it was.
    /// @param picture  of the error to write; empty: none. @throws Failure
    void judge(Contender& contender, BenchRow& row, const std::filesystem::path& picture) const;

private:
    struct Moment {
        Step step = {};
        image::Image truth = {};
    };
    image::Image trace(int samples, const std::function<void(double)>& progress) const;
    std::vector<Moment> along(const std::vector<Step>& steps, Console& console);
    FlickerError flicker(Contender& contender, const std::vector<Moment>& moments) const;

    field::Aspect aspect_;
    Reference& reference_;
    Stage stage_;
    glm::ivec2 size_;
    Step rest_;
    image::Image truth_ = {};
    image::Image bands_ = {};
    std::vector<Moment> camera_ = {};
    std::vector<Moment> light_ = {};
};

}  // namespace gnomon::client
