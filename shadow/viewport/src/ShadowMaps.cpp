#include <gnomon/math/ConvexBody.h>
#include <gnomon/shadow/Filter.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <algorithm>
#include <cmath>

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

/// Larger side of a texel of the map, in metres, where clip w is 1.
double texelMetres(const math::dmat4& clipFromWorld, int mapSize) {
    // Moving one metre across the light's view moves |row x| in clip units: the row without what it
    // has of w's, which an off-centre crop puts there.
    const math::dmat4 rows = glm::transpose(clipFromWorld);
    const math::dvec3 depth{rows[3]};
    const double square = glm::dot(depth, depth);
    const auto across = [&](const math::dvec4& row) {
        const math::dvec3 all{row};
        return glm::length(square > 0.0 ? all - depth * (glm::dot(all, depth) / square) : all);
    };
    const double x = across(rows[0]);
    const double y = across(rows[1]);
    const double least = std::min(x, y);
    return least > 0.0 ? 2.0 / (least * mapSize) : 0.0;
}

struct PageRange {
    int left = 0, right = -1, bottom = 0, top = -1;
};

/// The pages a view may look up: around the image of what it sees.
PageRange seenPages(const math::dmat4& clipFromWorld, std::span<const math::dvec3> seen,
                    int pagesPerSide, int mapSize) {
    const PageRange all{.left = 0, .right = pagesPerSide - 1, .bottom = 0, .top = pagesPerSide - 1};
    if (seen.empty()) return {};
    if (pagesPerSide == 1) return all;
    math::dvec2 low{1.0};
    math::dvec2 high{-1.0};
    for (const auto& p : seen) {
        const math::dvec4 clip = clipFromWorld * math::dvec4{p, 1.0};
        if (!(clip.w > 0.0)) return all;
        const math::dvec2 q = math::dvec2{clip} / clip.w;
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    // Four texels around: the normal offset and the filter.
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

/// As ShadowMap in LookupGlsl.cpp, std140.
struct ShadowMaps::MapBlock {
    math::mat4 clipFromOrigin{1.0F};
    math::vec4 texel{0.0F};
    glm::uvec4 pages{0U};
};

ShadowMaps::ShadowMaps(const gl::Api& gl)
    : gl_{gl}, mapsBuffer_{gl}, tableBuffer_{gl}, framebuffer_{gl}, compare_{gl} {
    mapsBuffer_.label("shadow maps");
    tableBuffer_.label("page table");
    framebuffer_.label("shadow page");
    gl_.NamedBufferStorage(mapsBuffer_.id(), sizeof(MapBlock) * maxMaps, nullptr,
                           GL_DYNAMIC_STORAGE_BIT);
    gl_.NamedBufferStorage(tableBuffer_.id(), sizeof(std::uint32_t) * maxTableEntries, nullptr,
                           GL_DYNAMIC_STORAGE_BIT);
    gl_.NamedFramebufferDrawBuffer(framebuffer_.id(), GL_NONE);
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    // Depth is reversed: lit where the receiver is at least as near to the light as the caster.
    gl_.SamplerParameteri(compare_.id(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
}

ShadowMaps::~ShadowMaps() = default;

ShadowMaps::Pool& ShadowMaps::pool(int pageSize) {
    auto& slot = pools_[pageSize];
    if (!slot) slot = std::make_unique<Pool>(gl_, pageSize);
    return *slot;
}

void ShadowMaps::release(Page& page) noexcept {
    if (page.layer >= 0) page.pool->give(page.layer);
    page.layer = -1;
}

void ShadowMaps::dropOld() {
    for (auto at = pages_.begin(); at != pages_.end();) {
        if (at->second.used + keepFrames >= round_) {
            ++at;
            continue;
        }
        release(at->second);
        at = pages_.erase(at);
    }
}

void ShadowMaps::invalidateAll() {
    for (auto& [key, page] : pages_) page.valid = false;
}

void ShadowMaps::invalidate(std::span<const math::Box> moved) {
    for (auto& [key, page] : pages_) {
        if (!page.valid) continue;
        for (const math::Box& box : moved) {
            const bool outside =
                box.empty() ||
                std::any_of(page.sides.begin(), page.sides.end(), [&](const math::Plane& side) {
                    const math::dvec3 furthest{side.normal.x > 0.0 ? box.max.x : box.min.x,
                                               side.normal.y > 0.0 ? box.max.y : box.min.y,
                                               side.normal.z > 0.0 ? box.max.z : box.min.z};
                    return side.distance(furthest) < 0.0;
                });
            if (outside) continue;
            page.valid = false;
            break;
        }
    }
}

ShadowStatistics ShadowMaps::prepare(std::span<const scene::ShadowState* const> states,
                                     const math::View& view, const math::Box& bounds,
                                     CasterSource& casters) {
    ShadowStatistics done;
    ++round_;
    ranges_.clear();
    blocks_.clear();
    table_.clear();
    bound_ = nullptr;
    math::ConvexBody body{math::frustumCorners(view.clipFromWorld())};
    body.clip(bounds);
    const auto seen = body.points();
    bool framed = false;

    for (const scene::ShadowState* state : states) {
        const int mapSize = state->mapSize;
        const int pageSize = state->pageSize;
        if (pageSize <= 0 || mapSize < pageSize || mapSize > 65536) continue;
        const int side = mapSize / pageSize;
        const FilterInfo* filter = findFilter(state->filter.get());
        done.degenerate += state->degenerate ? 1 : 0;
        if (blocks_.size() + state->clipFromWorld.size() > maxMaps ||
            table_.size() + state->clipFromWorld.size() * static_cast<std::size_t>(side * side) >
                maxTableEntries)
            continue;
        Pool& pagePool = pool(pageSize);
        bound_ = &pagePool;
        ranges_[state->light->id] = {
            .first = static_cast<std::uint32_t>(blocks_.size()),
            .count = static_cast<std::uint32_t>(state->clipFromWorld.size())};
        for (std::uint32_t map = 0; map < state->clipFromWorld.size(); ++map) {
            const math::dmat4& clipFromWorld = state->clipFromWorld[map];
            const math::dmat4 clipFromOrigin = clipFromWorld * translation(state->origin);
            const auto first = static_cast<std::uint32_t>(table_.size());
            table_.resize(table_.size() + static_cast<std::size_t>(side * side), missing);
            const PageRange wanted = seenPages(clipFromWorld, seen, side, mapSize);
            for (int y = wanted.bottom; y <= wanted.top; ++y) {
                for (int x = wanted.left; x <= wanted.right; ++x) {
                    const auto index = static_cast<std::uint32_t>(y * side + x);
                    Page& page = pages_[{.state = state->id(), .map = map, .page = index}];
                    page.used = round_;
                    if (page.pool != &pagePool) {
                        release(page);
                        page.pool = &pagePool;
                        page.valid = false;
                    }
                    if (page.layer < 0) page.layer = pagePool.take();
                    table_[first + index] = static_cast<std::uint32_t>(page.layer);
                    if (page.valid && page.clipFromWorld == clipFromWorld &&
                        page.origin == state->origin.get()) {
                        ++done.pagesKept;
                        continue;
                    }
                    const math::dmat4 decorate =
                        math::tileFromWhole(pageRect(x, y, pageSize, mapSize));
                    const auto planes = math::frustumPlanes(decorate * clipFromWorld);
                    std::copy_n(planes.begin(), 4, page.sides.begin());
                    if (!framed) {
                        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
                        gl_.Viewport(0, 0, pagePool.side(), pagePool.side());
                        gl_.Enable(GL_DEPTH_TEST);
                        gl_.Enable(GL_DEPTH_CLAMP);
                        gl_.DepthFunc(GL_GREATER);
                        gl_.DepthMask(GL_TRUE);
                        framed = true;
                    }
                    gl_.NamedFramebufferTextureLayer(framebuffer_.id(), GL_DEPTH_ATTACHMENT,
                                                     pagePool.texture(), 0, page.layer);
                    const float clear = 0.0F;
                    gl_.ClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &clear);
                    const auto drawn =
                        casters.drawCasters(math::mat4{decorate * clipFromOrigin}, page.sides);
                    page.clipFromWorld = clipFromWorld;
                    page.origin = state->origin;
                    page.valid = true;
                    ++done.pagesDrawn;
                    done.triangles += drawn.triangles;
                    done.texelsDrawn += static_cast<std::uint64_t>(pagePool.side()) *
                                        static_cast<std::uint64_t>(pagePool.side());
                }
            }
            const auto looked =
                static_cast<std::uint64_t>(std::max(0, wanted.right - wanted.left + 1) *
                                           std::max(0, wanted.top - wanted.bottom + 1));
            done.pagesUnseen += static_cast<std::uint64_t>(side * side) - looked;
            blocks_.push_back(
                {.clipFromOrigin = math::mat4{clipFromOrigin},
                 .texel = {static_cast<float>(texelMetres(clipFromWorld, mapSize)),
                           filter == nullptr ? 1.0F : filter->radiusTexels,
                           static_cast<float>(mapSize), static_cast<float>(pageSize)},
                 .pages = {static_cast<std::uint32_t>(side), first, table_[first], 0U}});
        }
    }
    if (framed) gl_.Disable(GL_DEPTH_CLAMP);
    if (!blocks_.empty()) {
        gl_.NamedBufferSubData(tableBuffer_.id(), 0,
                               static_cast<GLsizeiptr>(table_.size() * sizeof(std::uint32_t)),
                               table_.data());
    }
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
    gl_.BindSampler(pagesUnit, compare_.id());
    return {.mapsPerLight = static_cast<int>(most),
            .paged = std::any_of(arranged_.begin(), arranged_.end(),
                                 [](const MapBlock& block) { return block.pages.x > 1; })};
}

}  // namespace gnomon::shadow
