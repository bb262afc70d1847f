#include <gnomon/shadow/Filter.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "CasterVolume.h"
#include "Pool.h"

namespace gnomon::shadow {
namespace {

/// Pages nobody looked up for this many frames are given back.
constexpr std::uint64_t keepFrames = 240;
constexpr std::uint32_t missing = 0xffffffffU;

math::dmat4 translation(const math::dvec3& by) {
    math::dmat4 m{1.0};
    m[3] = math::dvec4{by, 1.0};
    return m;
}

/// Part of the map that page (x, y) covers, with its border.
math::Rect pageRect(int x, int y, int pageSize, int mapSize) {
    const double size = mapSize;
    return {.left = (x * pageSize - 1) / size,
            .bottom = (y * pageSize - 1) / size,
            .width = (pageSize + 2) / size,
            .height = (pageSize + 2) / size};
}

struct PageRange {
    int left = 0, right = -1, bottom = 0, top = -1;

    bool empty() const noexcept { return right < left || top < bottom; }
    std::uint64_t count() const noexcept {
        return empty() ? 0U : static_cast<std::uint64_t>((right - left + 1) * (top - bottom + 1));
    }
};

/// The pages a view may look up: around the image of what it sees.
PageRange seenPages(const SeenInMap& seen, int pagesPerSide, int mapSize) {
    const PageRange all{.left = 0, .right = pagesPerSide - 1, .bottom = 0, .top = pagesPerSide - 1};
    if (seen.anywhere) return all;
    if (seen.points.empty()) return {};
    math::dvec2 low{1.0};
    math::dvec2 high{-1.0};
    for (const auto& q : seen.points) {
        low = glm::min(low, math::dvec2{q});
        high = glm::max(high, math::dvec2{q});
    }
    // Four texels around, for the filter.
    const double slack = 8.0 / mapSize;
    const auto page = [&](double clip) {
        return static_cast<int>(
            std::clamp(std::floor((clip * 0.5 + 0.5) * pagesPerSide), 0.0, pagesPerSide - 1.0));
    };
    if (high.x < -1.0 - slack || low.x > 1.0 + slack || high.y < -1.0 - slack ||
        low.y > 1.0 + slack)
        return {};
    return {.left = page(low.x - slack),
            .right = page(high.x + slack),
            .bottom = page(low.y - slack),
            .top = page(high.y + slack)};
}

}  // namespace

/// As ShadowMap in LookupGlsl.cpp, std140. Without a map: a place far beyond its border.
struct ShadowMaps::MapBlock {
    math::mat4 mapFromOrigin{math::vec4{0.0F}, math::vec4{0.0F}, math::vec4{0.0F},
                             math::vec4{-1e6F, -1e6F, 1.0F, 1.0F}};
    math::vec4 fromFirst{1e-6F, 1e-6F, -1e6F, -1e6F};
    math::vec4 size{1.0F, 1.0F, 1.0F, 1.0F};
    glm::uvec4 pages{1U, 0U, 0U, 0U};
    math::vec4 alongU{0.0F};
    math::vec4 alongV{0.0F};
    math::vec4 light{0.0F, 1.0F, 0.0F, 0.0F};
    math::vec4 kernel{0.0F};
    bool perspective() const {
        return mapFromOrigin[0].w != 0.0F || mapFromOrigin[1].w != 0.0F ||
               mapFromOrigin[2].w != 0.0F || mapFromOrigin[3].w != 1.0F;
    }
};

/// What soft filters must know of a map.
/// @param wide  lookups go around a place, and choose among several maps by that
void ShadowMaps::soften(MapBlock& block, const scene::ShadowState& state, bool wide,
                        const math::dmat4& texelsFromWorld) {
    const math::dmat4 rows = glm::transpose(texelsFromWorld);
    const double steep = glm::length(math::dvec3{rows[2]});
    if (!(steep > 0.0)) return;  // no depth, no penumbra
    const math::dvec3 toward = math::dvec3{rows[2]} / steep;
    const auto [u, v] = shadow_fit::perpendicular(toward);
    const auto along = [&](const math::dvec3& axis, double more) {
        const math::dvec4 moved = texelsFromWorld * math::dvec4{axis, 0.0};
        return math::vec4{math::dvec4{moved.x, moved.y, moved.w, more}};
    };
    const math::dvec4 source = state.source;
    const bool parallel = source.w == 0.0;
    // Depth times w is linear in the distance along the rays (parallel light) or in its reciprocal.
    const double atLight = parallel ? 0.0 : glm::dot(rows[2], source);
    const double perDepth = parallel ? 1.0 / steep : atLight > 0.0 ? 1.0 / atLight : 0.0;
    block.light = {static_cast<float>(state.extent * perDepth),
                   static_cast<float>(parallel ? 1.0 : atLight / steep),
                   static_cast<float>(parallel ? 0.0 : -1.0 / steep), state.softness};
    // Of each side by itself: a cascade's may be of different lengths.
    const auto share = [&](const math::dvec4& row) {
        const math::dvec3 texels{row};
        return wide ? state.reach * std::hypot(glm::dot(texels, u), glm::dot(texels, v)) /
                          state.mapSize
                    : 0.0;
    };
    block.alongU = along(u, share(rows[0]));
    block.alongV = along(v, share(rows[1]));
    const int row = state.kernelSamples > 0 ? state.kernelSamples : state.kernelWidth;
    block.kernel = {static_cast<float>(state.kernelWidth), static_cast<float>(std::max(row, 1)),
                    state.reach, state.quality};
}

struct ShadowMaps::Page {
    Pool* pool = nullptr;
    int layer = -1;
    math::dmat4 clipFromWorld{0.0};  ///< of the map, when drawn
    math::dvec3 origin{0.0};
    DepthOffset offset = {};
    CasterVolume volume = {};  ///< what casts, when drawn
    bool valid = false;
    std::uint64_t used = 0;
};

struct ShadowMaps::Frame {
    const View& view;
    CasterSource& casters;
    Pool& pool;
    double leastTexels = 1.0;
    bool wholePages = false;  ///< are read, whatever of them is looked up
    bool wide = true;         ///< more than one place is read; not so by what blurs on the screen
    ShadowStatistics& done;
    SeenInMap seen = {};
    math::dmat4 firstFromWorld{1.0};  ///< of the light's first map, to its texels
    bool drawing = false;
    std::vector<int> drawn = {};  ///< layers

    DepthOffset offset() const { return view.offset == nullptr ? DepthOffset{} : *view.offset; }
};

ShadowMaps::ShadowMaps(const gl::Api& gl)
    : gl_{gl},
      mapsBuffer_{gl},
      tableBuffer_{gl},
      framebuffer_{gl},
      sampler_{texelSampler(gl)},
      comparing_{comparingSampler(gl)} {
    mapsBuffer_.label("shadow maps");
    tableBuffer_.label("page table");
    framebuffer_.label("shadow page");
    gl_.NamedBufferStorage(mapsBuffer_.id(), sizeof(MapBlock) * maxMaps, nullptr,
                           GL_DYNAMIC_STORAGE_BIT);
    gl_.NamedBufferStorage(tableBuffer_.id(), sizeof(std::uint32_t) * maxTableEntries, nullptr,
                           GL_DYNAMIC_STORAGE_BIT);
    gl_.NamedFramebufferDrawBuffer(framebuffer_.id(), GL_NONE);
}

ShadowMaps::~ShadowMaps() = default;

ShadowMaps::Pool& ShadowMaps::pool(int pageSize, const PyramidInfo* pyramid) {
    auto& slot = pools_[{pageSize, pyramid}];
    if (!slot) slot = std::make_unique<Pool>(gl_, pageSize, pyramid);
    return *slot;
}

void ShadowMaps::release(Page& page) noexcept {
    if (page.layer >= 0) page.pool->give(page.layer);
    page.layer = -1;
}

void ShadowMaps::dropOld() {
    for (auto at = pages_.begin(); at != pages_.end();) {
        if (at->second->used + keepFrames >= round_) {
            ++at;
            continue;
        }
        release(*at->second);
        at = pages_.erase(at);
    }
    std::erase_if(pools_, [&](const auto& entry) {
        return entry.second.get() != bound_ && entry.second->unused();
    });
}

void ShadowMaps::invalidateAll() {
    for (auto& [key, page] : pages_) page->valid = false;
}

void ShadowMaps::invalidate(std::span<const math::Box> moved) {
    for (auto& [key, page] : pages_) {
        if (!page->valid) continue;
        for (const math::Box& box : moved) {
            if (!mayIntersect(page->volume.planes(), box)) continue;
            page->valid = false;
            break;
        }
    }
}

void ShadowMaps::drawPage(Page& page, Frame& frame, const math::dmat4& decorate,
                          const math::dmat4& clipFromWorld, const scene::ShadowState& state) {
    const auto sides = math::frustumPlanes(decorate * clipFromWorld);
    page.volume.enclose(clipFromWorld, std::span{sides}.first(4),
                        frame.wholePages ? SeenInMap{.anywhere = true} : frame.seen,
                        2.0 * (frame.leastTexels + 1.0) / state.mapSize);
    if (!frame.drawing) {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
        gl_.Viewport(0, 0, frame.pool.side(), frame.pool.side());
        gl_.Enable(GL_DEPTH_TEST);
        gl_.Enable(GL_DEPTH_CLAMP);
        gl_.DepthFunc(GL_GREATER);
        gl_.DepthMask(GL_TRUE);
        if (frame.view.offset != nullptr) {
            gl_.Enable(GL_POLYGON_OFFSET_FILL);
            gl_.PolygonOffset(-frame.view.offset->factor, -frame.view.offset->units);
        }
        frame.drawing = true;
    }
    gl_.NamedFramebufferTextureLayer(framebuffer_.id(), GL_DEPTH_ATTACHMENT, frame.pool.texture(),
                                     0, page.layer);
    const float clear = 0.0F;
    gl_.ClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &clear);
    const auto drawn = frame.casters.drawCasters(
        {.clipFromOrigin = math::mat4{decorate * clipFromWorld * translation(state.origin)},
         .volume = page.volume.planes()});
    page.clipFromWorld = clipFromWorld;
    page.origin = state.origin;
    page.offset = frame.offset();
    page.valid = true;
    frame.drawn.push_back(page.layer);
    ++frame.done.pagesDrawn;
    frame.done.triangles += drawn.triangles;
    frame.done.texelsDrawn += static_cast<std::uint64_t>(frame.pool.side()) *
                              static_cast<std::uint64_t>(frame.pool.side());
}

void ShadowMaps::prepareMap(const scene::ShadowState& state, std::uint32_t map, Frame& frame) {
    const int mapSize = state.mapSize;
    const int pageSize = state.pageSize;
    const int side = mapSize / pageSize;
    const math::dmat4& clipFromWorld = state.clipFromWorld[map];
    const auto first = static_cast<std::uint32_t>(table_.size());
    table_.resize(table_.size() + static_cast<std::size_t>(side * side), missing);
    frame.seen.project(clipFromWorld, frame.view.seen,
                       {.source = state.source, .reach = state.reach});
    const PageRange wanted = seenPages(frame.seen, side, mapSize);
    for (int y = wanted.bottom; y <= wanted.top; ++y) {
        for (int x = wanted.left; x <= wanted.right; ++x) {
            const auto index = static_cast<std::uint32_t>(y * side + x);
            auto& slot = pages_[{.state = state.id(), .map = map, .page = index}];
            if (!slot) slot = std::make_unique<Page>();
            Page& page = *slot;
            page.used = round_;
            if (page.pool != &frame.pool) {
                release(page);
                page.pool = &frame.pool;
                page.valid = false;
            }
            if (page.layer < 0) page.layer = frame.pool.take();
            table_[first + index] = static_cast<std::uint32_t>(page.layer);
            if (page.valid && page.clipFromWorld == clipFromWorld &&
                page.origin == state.origin.get() && page.offset == frame.offset() &&
                page.volume.serves(frame.seen))
                ++frame.done.pagesKept;
            else
                drawPage(page, frame, math::tileFromWhole(pageRect(x, y, pageSize, mapSize)),
                         clipFromWorld, state);
        }
    }
    frame.done.pagesUnseen += static_cast<std::uint64_t>(side * side) - wanted.count();

    // To texels.
    math::dmat4 texelsFromClip{1.0};
    texelsFromClip[0][0] = texelsFromClip[1][1] = 0.5 * mapSize;
    texelsFromClip[3][0] = texelsFromClip[3][1] = 0.5 * mapSize;
    const math::dmat4 texelsFromWorld = texelsFromClip * clipFromWorld;
    if (map == 0) frame.firstFromWorld = texelsFromWorld;
    // Several maps of a light differ by scale and offset alone; what does not is left to the first.
    const math::dmat4 fromFirst = texelsFromWorld * glm::inverse(frame.firstFromWorld);
    MapBlock block{
        .mapFromOrigin = math::mat4{texelsFromWorld * translation(state.origin)},
        .fromFirst = {static_cast<float>(fromFirst[0][0]), static_cast<float>(fromFirst[1][1]),
                      static_cast<float>(fromFirst[3][0]), static_cast<float>(fromFirst[3][1])},
        .size = {static_cast<float>(mapSize), static_cast<float>(pageSize),
                 1.0F / static_cast<float>(pageSize + 2), 1.0F / static_cast<float>(mapSize)},
        .pages = {static_cast<std::uint32_t>(side), first, table_[first], 0U}};
    soften(block, state, frame.wide && state.clipFromWorld.size() > 1, texelsFromWorld);
    blocks_.push_back(block);
}

ShadowStatistics ShadowMaps::prepare(std::span<const scene::ShadowState* const> states,
                                     const View& view, CasterSource& casters) {
    ShadowStatistics done;
    ++round_;
    ranges_.clear();
    blocks_.clear();
    table_.clear();
    bound_ = nullptr;
    for (const scene::ShadowState* state : states) {
        const int mapSize = state->mapSize;
        const int pageSize = state->pageSize;
        ++done.refused;  // until it has its maps
        if (pageSize <= 0 || mapSize < pageSize || mapSize % pageSize != 0 || mapSize > 65536)
            continue;
        done.degenerate += state->degenerate ? 1 : 0;
        const std::size_t maps = state->clipFromWorld.size();
        const auto pages = static_cast<std::size_t>(mapSize / pageSize);
        if (blocks_.size() + maps > maxMaps ||
            table_.size() + maps * pages * pages > maxTableEntries)
            continue;
        const FilterInfo* filter = findFilter(state->filter.get());
        Pool& pagePool = pool(pageSize, filter == nullptr ? nullptr : filter->pyramid);
        if (bound_ != nullptr && bound_ != &pagePool) continue;
        bound_ = &pagePool;
        --done.refused;
        ranges_[state->light->id] = {.first = static_cast<std::uint32_t>(blocks_.size()),
                                     .count = static_cast<std::uint32_t>(maps)};
        Frame frame{
            .view = view,
            .casters = casters,
            .pool = pagePool,
            .leastTexels = filter == nullptr ? 1.0 : static_cast<double>(filter->leastTexels),
            .wholePages = filter != nullptr && filter->bleeds,
            .wide = filter == nullptr || !filter->onScreen,
            .done = done};
        for (std::uint32_t map = 0; map < maps; ++map) prepareMap(*state, map, frame);
        if (frame.drawing) {
            gl_.Disable(GL_DEPTH_CLAMP);
            gl_.Disable(GL_POLYGON_OFFSET_FILL);
            if (pagePool.hasPyramid())
                for (const int layer : frame.drawn) pagePool.summarise(layer);
        }
    }
    if (!blocks_.empty())
        gl_.NamedBufferSubData(tableBuffer_.id(), 0,
                               static_cast<GLsizeiptr>(table_.size() * sizeof(std::uint32_t)),
                               table_.data());
    for (const auto& [size, p] : pools_) done.bytes += p->bytes();
    dropOld();
    return done;
}

std::uint32_t ShadowMaps::count(field::Id light) const {
    const auto found = ranges_.find(light);
    return found == ranges_.end() ? 0U : found->second.count;
}

ShadowMaps::Arranged ShadowMaps::arrange(std::span<const field::Id> lights) {
    std::uint32_t most = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        most = std::max(most, count(lights[i]));
        if (count(lights[i]) > 0) last = i + 1;
    }
    if (most == 0) return {};
    arranged_.assign(std::min<std::size_t>(last * most, maxMaps), MapBlock{});
    for (std::size_t i = 0; i < last; ++i) {
        const auto found = ranges_.find(lights[i]);
        if (found == ranges_.end() || (i + 1) * most > arranged_.size()) continue;
        std::copy_n(blocks_.begin() + found->second.first, found->second.count,
                    arranged_.begin() + static_cast<std::ptrdiff_t>(i * most));
    }
    gl_.NamedBufferSubData(mapsBuffer_.id(), 0,
                           static_cast<GLsizeiptr>(arranged_.size() * sizeof(MapBlock)),
                           arranged_.data());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, mapsBinding, mapsBuffer_.id());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, tableBinding, tableBuffer_.id());
    gl_.BindTextureUnit(pagesUnit, bound_ == nullptr ? 0 : bound_->texture());
    gl_.BindSampler(pagesUnit, sampler_.id());
    gl_.BindTextureUnit(comparingUnit, bound_ == nullptr ? 0 : bound_->texture());
    gl_.BindSampler(comparingUnit, comparing_.id());
    gl_.BindTextureUnit(pyramidUnit, bound_ == nullptr ? 0 : bound_->pyramidTexture());
    const auto some = [&](auto&& is) {
        return std::any_of(arranged_.begin(), arranged_.end(), is);
    };
    return {.mapsPerLight = static_cast<int>(most),
            .lights = static_cast<int>(arranged_.size() / most),
            .paged = some([](const MapBlock& block) { return block.pages.x > 1; }),
            .perspective = some([](const MapBlock& block) { return block.perspective(); })};
}

}  // namespace gnomon::shadow
