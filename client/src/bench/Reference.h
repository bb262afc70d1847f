#pragma once

#include <gnomon/client/SceneSetup.h>
#include <gnomon/field/ChangeList.h>
#include <gnomon/scene/FlatScene.h>
#include <gnomon/scene/Types.h>
#include <gnomon/truth/Truth.h>

#include <filesystem>

#include "../Console.h"
#include "Plan.h"

namespace gnomon::client {

/// A scene, read once for everybody, and what exact rays say of it. Moving the eye or the light
/// builds nothing anew.
class Reference {
public:
    /// @throws Failure
    Reference(const std::filesystem::path& file, Console& console);
    ~Reference() = default;
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    const std::filesystem::path& file() const noexcept { return file_; }
    const field::TypeRegistry& types() const noexcept { return types_; }
    const field::ChangeList& imported() const noexcept { return imported_; }
    const scene::FlatScene& flat() const noexcept { return flat_; }
    /// The view with everything said: where it looks from, and suns by their direction.
    BenchView resolved(const BenchView& view, std::array<int, 2> size) const;

    truth::Truth truth(const math::View& view, const shadow_fit::LightShape& light,
                       const truth::TruthOptions& options);
    /// Thirds of the pixels with a surface, by distance: 0 near, 1 middle, 2 far; none: noBand.
    static constexpr std::uint8_t noBand = 255;
    image::Image bands(const math::View& view, int width, int height);

private:
    void lookFrom(const math::View& view);

    std::filesystem::path file_;
    field::TypeRegistry types_;
    field::ChangeList imported_;
    field::Aspect aspect_;
    PreparedScene prepared_ = {};
    scene::FlatScene flat_;
    truth::RayScene rays_;
    bool placed_ = false;
};

}  // namespace gnomon::client
