#pragma once

#include <filesystem>

#include "Judge.h"

namespace gnomon::client {

struct TrialSetup {
    const Chapter& chapter;
    BenchView view = {};  ///< resolved, with a size
    int frames = 50;      ///< of each contender, beside a few to warm up
    const CameraPath* path = nullptr;
    std::filesystem::path pictures = {};  ///< a folder; empty: no pictures of errors
    /// Starts the peers of one view, so many as can run.
    std::function<std::vector<std::unique_ptr<Contender>>(const Judge&, const BenchView&)> peers =
        {};
};

/// Draws a chapter's variants of one view in turn, frame by frame, so that a machine's mood hits
/// all alike. A dozen at most are held at a time; the first one is among each dozen, for the
/// ratios. One table for each kind of motion. @throws Failure
std::vector<BenchTable> runTrial(gl::Context& context, Reference& reference,
                                 const TrialSetup& setup, Console& console);

}  // namespace gnomon::client
