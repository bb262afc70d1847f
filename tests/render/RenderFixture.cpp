#include "RenderFixture.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon::render {

using math::dvec3;
using math::vec2;
using math::vec3;

field::TypeRegistry RenderTest::sceneTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

void RenderTest::SetUp() {
    GLTest::SetUp();
    if (HasFatalFailure()) return;
    edit(world)->addChild(root);
    renderer = std::make_unique<Renderer>(
        context(), server, [this](std::string text) { complaints.push_back(std::move(text)); });
}

void RenderTest::TearDown() {
    for (const auto& text : complaints) ADD_FAILURE() << "complaint: " << text;
    renderer.reset();
    GLTest::TearDown();
}

RenderTest::Mesh RenderTest::quad(const vec3& corner, const vec3& u, const vec3& v) {
    return {.positions = {corner, corner + u, corner + u + v, corner + v},
            .texCoords = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}},
            .indices = {0, 1, 2, 0, 2, 3}};
}

RenderTest::Mesh RenderTest::box(const vec3& low, const vec3& high) {
    const vec3 d = high - low;
    const vec3 x{d.x, 0.0F, 0.0F};
    const vec3 y{0.0F, d.y, 0.0F};
    const vec3 z{0.0F, 0.0F, d.z};
    Mesh all;
    const auto face = [&](const vec3& corner, const vec3& u, const vec3& v) {
        const Mesh one = quad(corner, u, v);
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
        all.texCoords.insert(all.texCoords.end(), one.texCoords.begin(), one.texCoords.end());
        for (const auto index : one.indices) all.indices.push_back(first + index);
    };
    face(low + z, x, y);
    face(low + x, -x, y);
    face(low + x + z, -z, y);
    face(low, z, y);
    face(low + y + z, x, -z);
    face(low, x, z);
    return all;
}

const scene::Geometry& RenderTest::add(const scene::Node& parent, const Mesh& mesh, bool closed) {
    const auto made = scene::makeNode<scene::Geometry>(app, "mesh");
    edit(parent)->addChild(made.node);
    vec3 low = mesh.positions.front();
    vec3 high = low;
    for (const vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    auto e = edit(made.core);
    e->positions = payloadOf(mesh.positions);
    e->texCoords = payloadOf(mesh.texCoords);
    e->indices = payloadOf(mesh.indices);
    e->chunks.assign({scene::Chunk{.indexCount = static_cast<std::uint32_t>(mesh.indices.size()),
                                   .closed = closed,
                                   .min = low,
                                   .max = high}});
    e->boundsMin = low;
    e->boundsMax = high;
    return made.core;
}

scene::NodeWith<scene::MaterialGroup> RenderTest::paint(const scene::Node& parent,
                                                        const scene::Material& material) {
    const auto made = scene::makeNode<scene::MaterialGroup>(app, "material");
    edit(parent)->addChild(made.node);
    edit(made.core)->material = material;
    return made;
}

const scene::PhongMaterial& RenderTest::phong(const vec3& color) {
    const auto& made = app.create<scene::PhongMaterial>();
    auto e = edit(made);
    e->diffuse = math::vec4{color, 1.0F};
    e->specular = vec3{0.0F};
    return made;
}

scene::NodeWith<scene::Transform> RenderTest::transform(const scene::Node& parent,
                                                        const math::Affine& matrix) {
    const auto made = scene::makeNode<scene::Transform>(app, "transform");
    edit(parent)->addChild(made.node);
    edit(made.core)->matrix = matrix;
    return made;
}

math::Affine RenderTest::lookFrom(const dvec3& from, const dvec3& to) {
    return math::toAffine(glm::inverse(math::lookAt(from, to, {0.0, 1.0, 0.0})));
}

const scene::MatrixCamera& RenderTest::topView() {
    const auto& camera = app.create<scene::MatrixCamera>();
    auto e = edit(camera);
    e->clipFromEye = math::orthographic({-8.0, -8.0, -40.0}, {8.0, 8.0, -1.0});
    e->eyeFromWorld = math::lookAt({0.0, 20.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    return camera;
}

const scene::PerspectiveCamera& RenderTest::perspectiveView(const dvec3& eye, const dvec3& to) {
    const auto beacon = transform(root, lookFrom(eye, to));
    const auto& camera = app.create<scene::PerspectiveCamera>();
    auto e = edit(camera);
    e->beacon = beacon.node;
    e->near = 0.1;
    e->far = 100.0;
    return camera;
}

RenderTest::View RenderTest::view(const scene::Camera& camera, int width, int height) {
    const auto& viewport = app.create<scene::ShadowViewport>();
    {
        auto e = edit(viewport);
        e->camera = camera;
        e->root = root;
        e->mapSize = 1024;
    }
    const auto& window = app.create<scene::Window>();
    {
        auto e = edit(window);
        e->size = glm::ivec2{width, height};
        e->viewports.assign({scene::Ref<scene::Viewport>{viewport}});
    }
    return {window, viewport};
}

void RenderTest::update() {
    const auto changes = app.commit();
    field::Applied applied;
    orThrow(session.apply(changes, &applied));
    fitter.update(session, applied);
    applied.clear();
    orThrow(server.apply(changes, &applied));
    orThrow(server.apply(session.commit(), &applied));
    renderer->update(applied);
    if (!fitter.wantsDepth()) return;
    fitter.fit(session, orThrow(renderer->depthSpan(false)));
    applied.clear();
    orThrow(server.apply(session.commit(), &applied));
    renderer->update(applied);
}

FrameStatistics RenderTest::draw(const View& view) {
    update();
    return orThrow(renderer->draw(copyOf(view.window), 0.0));
}

image::Image RenderTest::picture(const View& view) {
    draw(view);
    return renderer->read(copyOf(view.window));
}

image::Image RenderTest::factor(const View& view, const scene::Node& light) {
    update();
    return orThrow(renderer->shadowFactor(copyOf(view.window), 0, scene::Ref<scene::Node>{light}));
}

RenderTest::Rgb RenderTest::pixel(const image::Image& image, int x, int y) {
    const auto first =
        static_cast<std::size_t>(y * image.width + x) * static_cast<std::size_t>(image.channels);
    const auto value = [&](std::size_t c) {
        return int{
            image.pixels.at(first + std::min(c, static_cast<std::size_t>(image.channels - 1)))};
    };
    return {value(0), value(1), value(2)};
}

RenderTest::Rgb RenderTest::at(const image::Image& image, double x, double z) {
    return pixel(image, static_cast<int>((x + 8.0) / 16.0 * image.width),
                 static_cast<int>((z + 8.0) / 16.0 * image.height));
}

int RenderTest::encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(s * 255.0));
}

void RenderTest::expectClose(const Rgb& found, const Rgb& expected, int tolerance,
                             const std::string& what) {
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], tolerance) << what << ", channel " << c;
}

namespace {

/// They read maps as another filter does (pcf, vsm, hard), which is tried with every fit; what is
/// theirs shows with one warp and with cascades.
constexpr std::array<std::string_view, 7> variants{"rotated", "hardware", "square", "gauss",
                                                   "vsm16",   "evsm",     "evsm16"};

}  // namespace

std::vector<Technique> techniques() {
    std::vector<Technique> all;
    for (const shadow_fit::FitInfo& fit : shadow_fit::fits())
        for (const shadow::FilterInfo& filter : shadow::filters()) {
            const bool variant =
                std::find(variants.begin(), variants.end(), filter.name) != variants.end();
            if (!variant || fit.name == "lispsm" || fit.name == "csm") all.push_back({fit, filter});
        }
    return all;
}

std::string techniqueName(const testing::TestParamInfo<Technique>& info) {
    const std::string fit{info.param.fit.name};
    return info.param.hard() ? fit : fit + "_" + std::string{info.param.filter.name};
}

bool blocks(const math::Box& box, const dvec3& from, const dvec3& way, double reach) {
    double enter = 1e-9;
    double leave = reach;
    for (int i = 0; i < 3; ++i) {
        if (way[i] == 0.0) {
            if (from[i] < box.min[i] || from[i] > box.max[i]) return false;
            continue;
        }
        const double a = (box.min[i] - from[i]) / way[i];
        const double b = (box.max[i] - from[i]) / way[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

}  // namespace gnomon::render
