#pragma once

#include <gnomon/scene/ShadowState.h>
#include <gnomon/scene/Window.h>
#include <gnomon/shadow_fit/ClusterTree.h>
#include <gnomon/shadow_fit/Fit.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace gnomon::shadow_fit {

/// Keeps one ShadowState per light and fit group in the session's aspect: the one place where light
/// cameras are chosen, so that every tile and eye looks up the same maps.
///
/// A fit group is everything that looks through one screen: all its tiles and both eyes. Lights
/// that reach nothing visible get a state without maps. States whose light or viewport went away
/// are destroyed. Nothing is computed when nothing a fit depends on has changed.
class ShadowFitter {
public:
    /// @param warn  told once for each thing that cannot be done (an unknown technique).
    explicit ShadowFitter(std::function<void(std::string)> warn = {});
    ~ShadowFitter();

    /// @param session  may be edited here: it must write the space the states are made in.
    /// @param applied  what has changed in it since the last call.
    void update(field::Aspect& session, const field::Applied& applied);

    /// After update(): some fits wait for what is really seen (DepthUse::exact). Until fit() they
    /// are as they were, or as without depth where they are new.
    bool wantsDepth() const noexcept;
    /// Makes those fits. @param seen  of all windows together; nothing: nothing is seen
    void fit(field::Aspect& session, const std::optional<DepthSpan>& seen);
    /// After update(): depthSeen() is wanted of this frame (DepthUse::previous).
    bool tellsDepth() const noexcept { return previous_; }
    /// What was seen in a frame that was drawn; for the next update().
    void depthSeen(const std::optional<DepthSpan>& seen);

private:
    struct Group;
    struct Scene;
    struct Plan;
    void findWindows(const field::Aspect& session, const field::Applied& applied);
    void collectGroups(const field::Aspect& session, std::vector<Group>& groups) const;
    void fit(field::Aspect& session, const Group& group, const std::optional<DepthSpan>& depth);
    void fit(field::Aspect& session, const Group& group, const scene::FlatScene::LightUse& use,
             Plan& plan);
    bool keep(const Group& group);
    void dropUnused(field::Aspect& session);
    void warnOnce(const std::string& text);

    struct Key {
        field::Id light = {}, group = {};
        friend auto operator<=>(const Key&, const Key&) = default;
    };
    struct Held {
        field::Id state = {};
        std::uint64_t used = 0;  ///< the round it was last wanted in
    };

    std::function<void(std::string)> warn_;
    std::set<field::Id> windows_;
    std::map<Key, Held> states_;
    std::map<field::Id, std::unique_ptr<Scene>> scenes_;  ///< by root
    Receivers receivers_;                                 // kept for its memory
    std::vector<Group> waiting_;                          // for fit()
    std::optional<DepthSpan> lately_ = {};                // with its margin
    bool previous_ = false;
    bool depthChanged_ = false;
    std::vector<std::string> warned_;
    std::uint64_t round_ = 0;
};

/// A light's place and kind, in world space. Where its beacon has no usable direction, straight
/// down.
LightShape lightShape(const scene::FlatScene::LightUse& use);

/// Whether a viewport wants shadows of a light.
bool wantsShadows(const scene::ShadowViewport& viewport, const scene::FlatScene::LightUse& use);

}  // namespace gnomon::shadow_fit
