#pragma once

#include <GLTest.h>
#include <gnomon/image/Compare.h>
#include <gnomon/render/Renderer.h>
#include <gnomon/scene/Types.h>
#include <gnomon/shadow/Filter.h>
#include <gnomon/shadow_fit/ShadowFitter.h>

#include <array>
#include <cstdint>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace gnomon::render {

/// GLM's vectors are plain floats, though not trivially copyable in the language's sense.
template <class T>
field::Payload payloadOf(const std::vector<T>& items) {
    const auto bytes = std::as_bytes(std::span{items});
    return field::Payload{std::vector<std::byte>(bytes.begin(), bytes.end())};
}

/// Renders scenes whose pictures geometry can foretell. As in a session: the application's changes
/// go to the session, which fits shadows, and both go to the renderer's aspect.
///
/// topView() looks straight down at [-8, 8]^2: the world's x goes to the right, its z down.
class RenderTest : public gl::GLTest {
protected:
    void SetUp() override;
    void TearDown() override;

    // Scene.
    struct Mesh {
        std::vector<math::vec3> positions = {};
        std::vector<math::vec2> texCoords = {};
        std::vector<std::uint32_t> indices = {};
    };
    static Mesh quad(const math::vec3& corner, const math::vec3& u, const math::vec3& v);
    static Mesh box(const math::vec3& low, const math::vec3& high);
    /// Below @p parent, in a node of its own.
    const scene::Geometry& add(const scene::Node& parent, const Mesh& mesh, bool closed = false);
    scene::NodeWith<scene::MaterialGroup> paint(const scene::Node& parent,
                                                const scene::Material& material);
    const scene::PhongMaterial& phong(const math::vec3& color);
    scene::NodeWith<scene::Transform> transform(const scene::Node& parent,
                                                const math::Affine& matrix = {});
    /// A light whose subtree is everything added to its node.
    template <class Light>
    scene::NodeWith<Light> light(const scene::Node& parent, const math::dvec3& from,
                                 const math::dvec3& to) {
        const auto made = scene::makeNode<Light>(app, "light");
        edit(parent)->addChild(made.node);
        edit(made.core)->beacon = transform(root, lookFrom(from, to)).node;
        return made;
    }

    // Views.
    static math::Affine lookFrom(const math::dvec3& from, const math::dvec3& to);
    const scene::MatrixCamera& topView();
    const scene::PerspectiveCamera& perspectiveView(const math::dvec3& eye, const math::dvec3& to);
    struct View {
        const scene::Window& window;
        const scene::ShadowViewport& viewport;
    };
    View view(const scene::Camera& camera, int width, int height);

    // Pictures.
    /// The application's changes, and the fits: to the renderer. Exact depth is that of all
    /// windows.
    void update();
    FrameStatistics draw(const View& view);
    image::Image picture(const View& view);
    image::Image factor(const View& view, const scene::Node& light);
    using Rgb = std::array<int, 3>;
    static Rgb pixel(const image::Image& image, int x, int y);
    /// Of a top view, where the world is at (x, z).
    static Rgb at(const image::Image& image, double x, double z);
    /// The byte an sRGB picture has for a linear value.
    static int encoded(double linear);
    static void expectClose(const Rgb& found, const Rgb& expected, int tolerance,
                            const std::string& what);
    template <class T>
    const T& copyOf(const T& original) const {
        return *server.get(scene::Ref<T>{original});
    }

    static field::TypeRegistry sceneTypes();
    field::TypeRegistry types = sceneTypes();
    field::Aspect app{types, 1};
    field::Aspect session{types, 2};
    field::Aspect server{types, 0};
    shadow_fit::ShadowFitter fitter{[this](std::string text) { complaints.push_back(text); }};
    std::unique_ptr<Renderer> renderer;
    std::vector<std::string> complaints;
    /// Holds the root, so that a window that goes does not take the scene along.
    const scene::Node& world = app.create<scene::Node>();
    const scene::Node& root = app.create<scene::Node>();

private:
};

/// A fit and a filter.
struct Technique {
    shadow_fit::FitInfo fit = {};
    shadow::FilterInfo filter = {};
    /// What a viewport calls it.
    std::string word() const { return std::string{fit.name} + "+" + std::string{filter.name}; }
    bool hard() const noexcept { return filter.name == "hard"; }
};
inline void PrintTo(const Technique& technique, std::ostream* out) { *out << technique.word(); }
/// Every fit with every filter there is: suites run over them, so that a new one is tested the day
/// it is registered.
std::vector<Technique> techniques();
/// Names the rows of such suites: a fit alone where its filter is the hard one.
std::string techniqueName(const testing::TestParamInfo<Technique>& info);

/// Axis-aligned box against a ray: what shadows what, without any of the code under test.
/// @param reach  length of the ray, in lengths of @p way
bool blocks(const math::Box& box, const math::dvec3& from, const math::dvec3& way, double reach);

}  // namespace gnomon::render
