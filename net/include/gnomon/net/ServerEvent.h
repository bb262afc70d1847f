#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerMessages.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::net {

using wire::Activity;
using wire::Depth;
using wire::Digest;
using wire::Digests;
using wire::EventKind;
using wire::Log;
using wire::LogLevel;
using wire::Ready;
using wire::RenderStats;
using wire::SyncParameters;
using InputEvent = wire::Event;

/// The deadline passed.
struct Nothing {};

/// A client is here: begin with an empty aspect. A Snapshot follows.
struct ClientJoined {
    std::string who = {};  ///< its address
    SyncParameters sync = {};
};

/// The whole session as of frame n: apply to an empty aspect, render it, send Ready{n}.
struct Snapshot {
    std::uint64_t n = 0;
    double time = 0;  ///< seconds, the application's clock
    field::ChangeList changes = {};
};

/// Apply, render, send Ready{n}. Numbers follow the snapshot's without a gap. Every payload the
/// changes name is with them.
struct Frame {
    std::uint64_t n = 0;
    double time = 0;          ///< seconds, the application's clock
    bool capture = false;     ///< send the Images of this frame, then Ready
    bool digest = false;      ///< send Digest{n, aspect.digest()}, then Ready
    bool digests = false;     ///< send digestsOf(n, aspect), then Ready
    bool wantsDepth = false;  ///< send Depth{n}, and wait for Fit{n} before rendering with it
    bool tellsDepth = false;  ///< send Depth{n}, as it was rendered, then Ready
    field::ChangeList changes = {};
};

Digests digestsOf(std::uint64_t n, field::Aspect& aspect);

/// The fit of frame n, made from everybody's Depth.
struct Fit {
    std::uint64_t n = 0;
    field::ChangeList changes = {};
};

/// Show frame n now. While this server catches up it may name a frame that was never rendered
/// here, or come before the frame's Ready: then ignore it, or show the frame when it is done.
struct Swap {
    std::uint64_t n = 0;
};

/// The client is gone; leave the last frame on the wall.
struct ClientLeft {
    std::string why = {};
};

/// End the program.
struct Quit {};

using ServerEvent =
    std::variant<Nothing, ClientJoined, Snapshot, Frame, Fit, Swap, ClientLeft, Quit>;

/// What waits behind the event taken last, so that a server that is behind can skip rendering.
struct Queued {
    std::uint64_t newestFrame = 0;  ///< 0: none waits
    std::uint64_t newestSwap = 0;   ///< 0: none waits
    bool clientLeft = false;
    bool quit = false;
};

/// A captured picture, or a part of a window.
struct Image {
    std::uint64_t n = 0;
    std::uint64_t window = 0;  ///< field::Id of the window's container
    std::uint32_t x = 0;       ///< where in the window, pixels from the left
    std::uint32_t y = 0;       ///< pixels from the top
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint8_t channels = 3;              ///< 3: RGB, 4: RGBA
    std::vector<std::uint8_t> pixels = {};  ///< top row first, width * height * channels
};

}  // namespace gnomon::net
