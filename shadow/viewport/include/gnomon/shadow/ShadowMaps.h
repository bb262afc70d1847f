#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/ShadowState.h>
#include <gnomon/shadow/Filter.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
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
    struct Pass {
        math::mat4 clipFromOrigin{1.0F};  ///< of the page, relative to the group's origin
        /// What casts is not outside any of these; inner sides, world.
        std::span<const math::Plane> volume = {};
    };
    /// Draws the depth of every caster that may touch the volume into the bound framebuffer.
    virtual Drawn drawCasters(const Pass& pass) = 0;
};

/// How far casters are pushed away from the light, as glPolygonOffset takes it (negated: depth is
/// reversed). The lookup needs none: for those who have set it by hand.
struct DepthOffset {
    float factor = 0.0F;  ///< times the depth a texel's width of the caster spans
    float units = 0.0F;   ///< of depth resolution
    friend bool operator==(const DepthOffset&, const DepthOffset&) = default;
};

struct ShadowStatistics {
    std::uint64_t pagesDrawn = 0;
    std::uint64_t pagesKept = 0;    ///< looked up, unchanged since they were drawn
    std::uint64_t pagesUnseen = 0;  ///< of these maps, that this view does not look up
    std::uint64_t texelsDrawn = 0;
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;  ///< of all pages held
    int degenerate = 0;
    int refused = 0;  ///< lights whose maps there is no room for: they shadow nothing
};

/// The maps of all lights that one server looks up: one array of pages a page size, one table.
///
/// A page is a fixed square part of a map, with a border of one texel, drawn with its own viewport
/// and its own decorated projection: the same bits wherever it is drawn. It is drawn when a view
/// looks it up and its fit or what casts into it has changed since; and then only with casters that
/// can reach what the view sees.
class ShadowMaps {
public:
    static constexpr int maxMaps = 128;  ///< a frame and viewport
    static constexpr int maxTableEntries = 4096;
    static constexpr GLuint mapsBinding = 4;  ///< uniform buffers
    static constexpr GLuint tableBinding = 5;
    static constexpr GLuint pagesUnit = 8;  ///< texture units
    static constexpr GLuint pyramidUnit = 9;
    static constexpr GLuint comparingUnit = 13;  ///< the pages again, compared when they are read

    explicit ShadowMaps(const gl::Api& gl);
    ~ShadowMaps();

    /// Drops pages that something moved in. Called once a frame, before prepare().
    void invalidate(std::span<const math::Box> movedWorld);
    void invalidateAll();

    struct View {
        std::span<const math::dvec3> seen = {};  ///< what is seen lies in their convex hull
        const DepthOffset* offset = nullptr;     ///< nullptr: none
    };
    /// Draws what is missing for one viewport.
    /// @param states   of the viewport's fit group; all of one page size
    /// Leaves its own framebuffer bound where it drew anything.
    ShadowStatistics prepare(std::span<const scene::ShadowState* const> states, const View& view,
                             CasterSource& casters);
    /// How the lookup's text has to be specialised.
    struct Arranged {
        int mapsPerLight = 0;      ///< MAPS_PER_LIGHT; 0 where no light has a map
        int lights = 0;            ///< the first so many lights have a place in the block
        bool paged = false;        ///< PAGED_MAPS: some map has more than one page
        bool perspective = false;  ///< PERSPECTIVE_MAPS: some map has a w that is not 1
        bool images = false;       ///< there are no maps but images of factors, one a light
        friend bool operator==(const Arranged&, const Arranged&) = default;
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
    struct Page;
    struct MapBlock;
    struct Frame;  // what prepare() works with

    static void soften(MapBlock& block, const scene::ShadowState& state, bool wide,
                       const math::dmat4& texelsFromWorld);

    void prepareMap(const scene::ShadowState& state, std::uint32_t map, Frame& frame);
    void drawPage(Page& page, Frame& frame, const math::dmat4& decorate,
                  const math::dmat4& clipFromWorld, const scene::ShadowState& state);
    void release(Page& page) noexcept;
    void dropOld();
    Pool& pool(int pageSize, const PyramidInfo* pyramid);

    const gl::Api& gl_;
    std::map<std::pair<int, const PyramidInfo*>, std::unique_ptr<Pool>> pools_;
    std::map<PageKey, std::unique_ptr<Page>> pages_;
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    std::map<field::Id, Range> ranges_;  ///< in blocks_, by light
    gl::Buffer mapsBuffer_;
    gl::Buffer tableBuffer_;
    gl::Framebuffer framebuffer_;
    gl::Sampler sampler_, comparing_;
    std::vector<MapBlock> blocks_;
    std::vector<MapBlock> arranged_;
    std::vector<std::uint32_t> table_;
    Pool* bound_ = nullptr;
    std::uint64_t round_ = 0;
};

}  // namespace gnomon::shadow
