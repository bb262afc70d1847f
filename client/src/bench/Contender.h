#pragma once

#include <gnomon/gl/Context.h>
#include <gnomon/image/Image.h>

#include <functional>
#include <memory>
#include <string>

#include "Plan.h"
#include "Stage.h"
#include "Table.h"

namespace gnomon::client {

/// Something that draws one view with one technique, frame by frame, in turn with others.
class Contender {
public:
    Contender() = default;
    virtual ~Contender() = default;
    Contender(const Contender&) = delete;
    Contender& operator=(const Contender&) = delete;

    /// Draws a frame, whole. Returns how long that took, milliseconds. @throws Failure
    virtual double frame(Motion motion) = 0;
    /// The measured light's factor as of now. @throws Failure
    virtual image::Image factor() = 0;
    /// Moves eye and light for the next factor(). @throws Failure
    virtual void take(const Step& step) = 0;
    /// Name, and what the last frame cost beside time.
    virtual BenchRow row() const = 0;
};

/// Ours: a session with everything of its own but the context.
std::unique_ptr<Contender> makeContender(gl::Context& context, const Reference& reference,
                                         const BenchView& view, const Variant& variant,
                                         std::function<void(std::string)> report);

}  // namespace gnomon::client
