#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/ShadowState.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// Draws what may cast a shadow. The renderer's side of a shadow pass.
class CasterSource {
public:
    virtual ~CasterSource() = default;
    struct Drawn {
        std::uint64_t triangles = 0;
        std::uint64_t chunks = 0;
    };
    /// Draws the depth of every caster that may touch the volume into the bound framebuffer.
    /// @param clipFromOrigin  of the page, relative to the group's origin
    /// @param sidesWorld      left, right, bottom, top of the page's volume, inner sides
    virtual Drawn drawCasters(const math::mat4& clipFromOrigin,
                              std::span<const math::Plane> sidesWorld) = 0;
};

struct ShadowStatistics {
    std::uint64_t pagesDrawn = 0;
    std::uint64_t pagesKept = 0;    ///< looked up, unchanged since they were drawn
    std::uint64_t pagesUnseen = 0;  ///< of these maps, that this view does not look up
    std::uint64_t texelsDrawn = 0;
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;  ///< of all pages held
    int degenerate = 0;
};

/// The maps of all lights that one server looks up: one array of pages a page size, one table.
///
/// A page is a fixed square part of a map, with a border of one texel, drawn with its own viewport
/// and its own decorated projection: the same bits wherever it is drawn. It is drawn when a view
/// looks it up and its fit or what casts into it has changed since.
class ShadowMaps {
public:
    static constexpr int maxMaps = 128;  ///< a frame and viewport
    static constexpr int maxTableEntries = 4096;
    static constexpr GLuint mapsBinding = 4;  ///< uniform buffers
    static constexpr GLuint tableBinding = 5;
    static constexpr GLuint pagesUnit = 8;  ///< texture unit

    explicit ShadowMaps(const gl::Api& gl);
    ~ShadowMaps();

    /// Drops pages that something moved in. Called once a frame, before prepare().
    void invalidate(std::span<const math::Box> movedWorld);
    void invalidateAll();

    /// Draws what is missing for one viewport.
    /// @param states   of the viewport's fit group; all of one page size
    /// @param view     what the viewport shows (its tile)
    /// @param bounds   of the scene
    /// Leaves its own framebuffer bound.
    ShadowStatistics prepare(std::span<const scene::ShadowState* const> states,
                             const math::View& view, const math::Box& bounds,
                             CasterSource& casters);
    /// How the lookup's text has to be specialised.
    struct Arranged {
        int mapsPerLight = 0;  ///< MAPS_PER_LIGHT; 0 where no light has a map
        bool paged = false;    ///< PAGED_MAPS: some map has more than one page
    };
    /// Puts the maps in the order of the lights that are shaded and binds maps, table and pages for
    /// the lookup. After prepare().
    /// @param lights  nodes; the maps of the i-th begin at i * maps per light
    Arranged arrange(std::span<const field::Id> lights);
    /// How many maps a light has, after prepare().
    std::uint32_t count(field::Id light) const;

private:
    class Pool;
    struct PageKey {
        field::Id state = {};
        std::uint32_t map = 0;
        std::uint32_t page = 0;
        friend auto operator<=>(const PageKey&, const PageKey&) = default;
    };
    struct Page {
        Pool* pool = nullptr;
        int layer = -1;
        math::dmat4 clipFromWorld{0.0};  ///< of the map, when drawn
        math::dvec3 origin{0.0};
        std::array<math::Plane, 4> sides = {};
        bool valid = false;
        std::uint64_t used = 0;
    };
    struct MapBlock;

    void release(Page& page) noexcept;
    void dropOld();
    Pool& pool(int pageSize);

    const gl::Api& gl_;
    std::map<int, std::unique_ptr<Pool>> pools_;
    std::map<PageKey, Page> pages_;
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    std::map<field::Id, Range> ranges_;  ///< in blocks_, by light
    gl::Buffer mapsBuffer_;
    gl::Buffer tableBuffer_;
    gl::Framebuffer framebuffer_;
    gl::Sampler compare_;
    std::vector<MapBlock> blocks_;
    std::vector<MapBlock> arranged_;
    std::vector<std::uint32_t> table_;
    Pool* bound_ = nullptr;
    std::uint64_t round_ = 0;
};

}  // namespace gnomon::shadow
