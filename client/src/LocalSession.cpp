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
    field::Applied inSession;
    field::Applied inReplica;
    field::ChangeList edits = aspect_.commit();
    orThrow(session_.apply(edits, &inSession));
    fitter_.update(session_, inSession);
    edits.append(session_.commit());
    orThrow(replica_.apply(edits, &inReplica));
    aspect_.takeUnusedPayloads();
    session_.takeUnusedPayloads();
    replica_.takeUnusedPayloads();
    if (!inReplica.empty()) renderer_->update(inReplica);
}

std::unique_ptr<gl::Context> makeContext(const std::string& backend) {
    return orThrow(gl::createContext({.backend = orThrow(gl::parseBackend(backend))}));
}

}  // namespace gnomon::client
