#include "RayShadows.h"

#include <gnomon/truth/LightSampler.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "Glsl.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::dvec4;
using truth::RayPacket;

constexpr int samplesOfExtent = 16;

unsigned threadCount() {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    const char* asked = std::getenv("LP_NUM_THREADS");
    const int wanted = asked == nullptr ? 0 : std::atoi(asked);
    return wanted > 0 ? std::min(static_cast<unsigned>(wanted), cores) : cores;
}

/// Where the surfaces of a depth image are.
class Surfaces {
public:
    Surfaces(const RayShadows::Pass& pass, const dvec3& origin, const std::vector<float>& depths)
        : worldFromClip_{glm::inverse(pass.clipFromWorld)},
          origin_{origin},
          pixels_{pass.pixels},
          depths_{depths} {}

    struct Point {
        bool there = false;
        dvec3 position{0.0};  ///< relative to the origin, off the surface on the side that is seen
    };
    Point at(int x, int y) const {
        const float depth =
            depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels_.width) +
                    static_cast<std::size_t>(x)];
        if (!(depth > 0.0F)) return {};
        const double cx = (x + 0.5) / pixels_.width * 2.0 - 1.0;
        const double cy = (y + 0.5) / pixels_.height * 2.0 - 1.0;
        const dvec4 base = worldFromClip_[0] * cx + worldFromClip_[1] * cy + worldFromClip_[3];
        const dvec3 surface = project(base + worldFromClip_[2] * static_cast<double>(depth));
        const dvec3 toEye = project(base + worldFromClip_[2]) - surface;
        const double away = glm::length(toEye);
        // Vertices and transforms are exact to what floats of this size can tell; a depth, to what
        // is left of the largest in its triangle, along this very line.
        const dvec3 size = glm::abs(surface);
        const dvec3 nearer = project(base + worldFromClip_[2] * (depth + 0x1p-24));
        const double slack =
            0x1p-20 * (1.0 + std::max({size.x, size.y, size.z})) + glm::length(nearer - surface);
        return {.there = true,
                .position = away > slack ? surface + toEye * (slack / away) : surface};
    }

private:
    dvec3 project(const dvec4& p) const { return dvec3{p} / p.w - origin_; }
    math::dmat4 worldFromClip_;
    dvec3 origin_;
    scene::PixelRect pixels_;
    const std::vector<float>& depths_;
};

/// One light's factors in blocks of eight pixels in a row.
class Tracer {
public:
    Tracer(const truth::RayScene& scene, const shadow_fit::LightShape& light)
        : scene_{scene},
          sampler_{light, scene.origin()},
          samples_{sampler_.hasExtent() ? samplesOfExtent : 1} {}

    void row(const Surfaces& surfaces, int y, int width, std::uint8_t* factors) const {
        for (int x = 0; x < width; x += RayPacket::size) {
            const int count = std::min<int>(RayPacket::size, width - x);
            std::array<dvec3, RayPacket::size> positions;
            unsigned there = 0;
            for (int i = 0; i < count; ++i) {
                const auto point = surfaces.at(x + i, y);
                positions[static_cast<std::size_t>(i)] = point.position;
                if (point.there && sampler_.shinesAt(point.position)) there |= 1U << i;
            }
            std::array<int, RayPacket::size> lit{};
            if (there != 0)
                for (int s = 0; s < samples_; ++s) trace(positions, there, s, lit);
            for (int i = 0; i < count; ++i)
                factors[x + i] = static_cast<std::uint8_t>(
                    (lit[static_cast<std::size_t>(i)] * 255 + samples_ / 2) / samples_);
        }
    }

private:
    void trace(const std::array<dvec3, RayPacket::size>& positions, unsigned there, int sample,
               std::array<int, RayPacket::size>& lit) const {
        RayPacket packet;
        for (std::size_t i = 0; i < RayPacket::size; ++i) {
            if ((there >> i & 1U) == 0) continue;
            const auto ray =
                samples_ == 1
                    ? sampler_.centre(positions[i])
                    : sampler_.sample(positions[i],
                                      truth::stratified(static_cast<std::uint32_t>(sample), 0));
            packet.set(i, positions[i], ray.direction, ray.reach);
        }
        const unsigned blocked = scene_.blocked(packet);
        for (std::size_t i = 0; i < RayPacket::size; ++i)
            lit[i] += (there >> i & 1U) != 0 && (blocked >> i & 1U) == 0 ? 1 : 0;
    }

    const truth::RayScene& scene_;
    truth::LightSampler sampler_;
    int samples_;
};

}  // namespace

RayShadows::RayShadows(const gl::Api& gl) : gl_{gl}, framebuffer_{gl}, threads_{threadCount()} {
    gl_.NamedFramebufferDrawBuffer(framebuffer_.id(), GL_NONE);
}

bool RayShadows::has(const Pass& pass, std::span<const Light> lights) const {
    // What the lights are is part of the scene's version.
    return pass == last_ && lights.size() == lights_.size() && !lights_.empty() &&
           std::equal(lights.begin(), lights.end(), lights_.begin(),
                      [](const Light& a, const Light& b) { return a.layer == b.layer; });
}

void RayShadows::begin(const Pass& pass, int layers) {
    if (pass.size != size_ || layers > layers_) {
        size_ = pass.size;
        layers_ = layers;
        factors_ = gl::Texture{gl_, GLenum{GL_TEXTURE_2D_ARRAY}};
        factors_.label("ray-traced shadow factors");
        gl_.TextureStorage3D(factors_.id(), 1, GL_R8, size_.x, size_.y, layers_);
        gl_.TextureParameteri(factors_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_.TextureParameteri(factors_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        depth_ = gl::Texture{gl_, GLenum{GL_TEXTURE_2D}};
        depth_.label("depth for rays");
        gl_.TextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, size_.x, size_.y);
        gl_.NamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Viewport(pass.pixels.x, pass.pixels.y, pass.pixels.width, pass.pixels.height);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
    const float clear = 0.0F;
    gl_.ClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &clear);
}

void RayShadows::end(const Pass& pass, std::span<const Light> lights,
                     const truth::RayScene& scene) {
    const auto& at = pass.pixels;
    const auto width = static_cast<std::size_t>(at.width);
    const std::size_t count = width * static_cast<std::size_t>(at.height);
    depths_.resize(count);
    traced_.resize(count);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    gl_.ReadPixels(at.x, at.y, at.width, at.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
    const Surfaces surfaces{pass, scene.origin(), depths_};
    for (const Light& light : lights) {
        const Tracer tracer{scene, light.shape};
        std::atomic<int> next{0};
        const auto work = [&] {
            for (int y = next++; y < at.height; y = next++)
                tracer.row(surfaces, y, at.width,
                           traced_.data() + static_cast<std::size_t>(y) * width);
        };
        {
            std::vector<std::jthread> helpers;
            for (unsigned i = 1; i < threads_; ++i) helpers.emplace_back(work);
            work();
        }
        gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        gl_.TextureSubImage3D(factors_.id(), 0, at.x, at.y, light.layer, at.width, at.height, 1,
                              GL_RED, GL_UNSIGNED_BYTE, traced_.data());
    }
    last_ = pass;
    lights_.assign(lights.begin(), lights.end());
}

void RayShadows::bind() const {
    gl_.BindTextureUnit(glsl::factorUnit, factors_.id());
    gl_.BindSampler(glsl::factorUnit, 0);
}

}  // namespace gnomon::render
