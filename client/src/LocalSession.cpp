#include "LocalSession.h"

#include <gnomon/scene/Types.h>

namespace gnomon::client {

field::TypeRegistry LocalSession::makeTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

LocalSession::LocalSession(gl::Context& context, std::function<void(std::string)> report)
    : types_{makeTypes()},
      aspect_{types_, 2},
      session_{types_, 1},
      replica_{types_, 0},
      fitter_{report},
      context_{context},
      renderer_{std::make_unique<render::Renderer>(context_, replica_, std::move(report))} {}

LocalSession::~LocalSession() {
    context_.makeCurrent();
    renderer_.reset();
}

const scene::Window& LocalSession::rendered(field::Ref<scene::Window> window) const {
    const auto* found = replica_.get(window);
    GNOMON_EXPECTS(found != nullptr, "commit() before drawing");
    return *found;
}

void LocalSession::commit() {
    // As the servers' Depth of the frame before, and of this one.
    if (drawn_ && fitter_.tellsDepth()) fitter_.depthSeen(orThrow(renderer_->depthSpan(true)));
    drawn_ = true;
    field::Applied inSession;
    field::ChangeList edits = aspect_.commit();
    orThrow(session_.apply(edits, &inSession));
    fitter_.update(session_, inSession);
    edits.append(session_.commit());
    replicate(std::move(edits));
    if (fitter_.wantsDepth()) {
        fitter_.fit(session_, orThrow(renderer_->depthSpan(false)));
        replicate(session_.commit());
    }
}

void LocalSession::replicate(field::ChangeList changes) {
    field::Applied applied;
    orThrow(replica_.apply(changes, &applied));
    if (!applied.empty()) renderer_->update(applied);
}

std::unique_ptr<gl::Context> makeContext(const std::string& backend) {
    return orThrow(gl::createContext({.backend = orThrow(gl::parseBackend(backend))}));
}

}  // namespace gnomon::client
