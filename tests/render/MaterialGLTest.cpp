// Materials: what they cast, and how what they show is darkened.
#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

class MaterialGLTest : public RenderTest {
protected:
    void ground(const scene::Node& below, const scene::Material& material) {
        add(paint(below, material).node,
            quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
    }
    void caster(const scene::Node& below) {
        add(paint(below, phong(vec3{0.8F})).node,
            box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}), true);
    }
    const scene::Texture& texture(int width, int height, const std::vector<std::uint8_t>& rgba) {
        const auto& made = app.create<scene::Texture>();
        auto e = edit(made);
        e->pixels = field::Payload::of<std::uint8_t>(rgba);
        e->size = glm::ivec2{width, height};
        e->nearest = true;
        e->mipmaps = false;
        e->wrapS = scene::Texture::Wrap::clamp;
        e->wrapT = scene::Texture::Wrap::clamp;
        return made;
    }
    /// An application's shader: one colour, which knows of no light.
    const scene::ShaderMaterial& foreign(const std::string& color) {
        const auto& made = app.create<scene::ShaderMaterial>();
        auto e = edit(made);
        e->vertexSource = R"(layout(location = 0) in vec3 position;
            uniform mat4 gnomonClipFromLocal;
            void main() { gl_Position = gnomonClipFromLocal * vec4(position, 1.0); })";
        e->fragmentSource =
            "layout(location = 0) out vec4 o; void main() { o = vec4(" + color + ", 1.0); }";
        return made;
    }
    static constexpr double cosine = 0.8944271909999159;  // of the sun from (-1, 2, 0)
};

TEST_F(MaterialGLTest, AForeignMaterialIsDarkenedInShadowAndItsAmbientIsNotDarkenedTwice) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    edit(sun.core)->ambient = vec3{0.1F};
    ground(sun.node, foreign("0.5, 0.5, 0.5"));
    caster(sun.node);
    const View top = view(topView(), 128, 128);
    const auto shown = picture(top);
    const int plain = encoded(0.5);
    expectClose(at(shown, -5.0, 3.0), {plain, plain, plain}, 1, "lit: as the shader drew it");
    // In shadow what is left is the ambient share: of the sky, and of the light itself.
    const auto share = [&](double sky) {
        return encoded(0.5 * (sky + 0.1) / (sky + 0.1 + cosine));
    };
    expectClose(at(shown, 1.5, 0.0), {share(0.20), share(0.22), share(0.26)}, 2, "shadowed");
    EXPECT_TRUE(renderer->animates());
}

TEST_F(MaterialGLTest, AForeignMaterialIsNotDarkenedWithoutShadows) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node, foreign("0.5, 0.25, 0.1"));
    caster(sun.node);
    const View top = view(topView(), 64, 64);
    edit(top.viewport)->technique = "none";
    const Rgb plain{encoded(0.5), encoded(0.25), encoded(0.1)};
    const auto shown = picture(top);
    expectClose(at(shown, 1.5, 0.0), plain, 1, "under the box");
    expectClose(at(shown, -5.0, 3.0), plain, 1, "beside it");
}

TEST_F(MaterialGLTest, AForeignMaterialSeesItsUniforms) {
    const auto& own = app.create<scene::ShaderMaterial>();
    {
        auto e = edit(own);
        e->vertexSource = R"(layout(location = 0) in vec3 position;
            layout(location = 2) in vec2 texCoord;
            uniform mat4 gnomonClipFromLocal;
            out vec2 uv;
            void main() { uv = texCoord; gl_Position = gnomonClipFromLocal * vec4(position, 1.0); })";
        e->fragmentSource =
            R"(in vec2 uv; uniform sampler2D gnomonTexture; uniform float gnomonTime;
            layout(location = 0) out vec4 o;
            void main() { o = texture(gnomonTexture, uv) * step(gnomonTime, 1.0); })";
        e->texture = texture(2, 1, {255, 0, 0, 255, 0, 255, 0, 255});
    }
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node, own);
    const View top = view(topView(), 64, 64);
    const auto shown = picture(top);
    EXPECT_EQ(at(shown, -4.0, 0.0), (Rgb{255, 0, 0}));
    EXPECT_EQ(at(shown, 4.0, 0.0), (Rgb{0, 255, 0}));
    ASSERT_TRUE(renderer->draw(copyOf(top.window), 2.0).has_value());
    EXPECT_EQ(at(renderer->read(copyOf(top.window)), 4.0, 0.0), (Rgb{0, 0, 0}));
}

TEST_F(MaterialGLTest, AForeignShaderThatDoesNotCompileIsReported) {
    const auto& own = foreign("nonsense");
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node, own);
    const View top = view(topView(), 64, 64);
    picture(top);
    draw(top);
    ASSERT_EQ(complaints.size(), 1U) << "told once";
    EXPECT_NE(complaints[0].find("nonsense"), std::string::npos) << complaints[0];
    complaints.clear();
}

TEST_F(MaterialGLTest, AMaskedCasterCastsItsMask) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node, phong(vec3{0.8F}));
    const auto& masked = phong(vec3{1.0F});
    {
        auto e = edit(masked);
        e->alpha = scene::PhongMaterial::Alpha::mask;
        e->doubleSided = true;
        // Left opaque, right clear.
        e->diffuseMap = texture(2, 1, {255, 255, 255, 255, 255, 255, 255, 0});
    }
    // Hung beside what is seen, so that its shadow alone is in the picture.
    add(paint(sun.node, masked).node,
        quad({-18.0F, 10.0F, 4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -8.0F}));
    const View top = view(topView(), 128, 128);
    const auto shadow = factor(top, sun.node);
    // x in [-18, -10] falls on [-8, 0]: the opaque half on [-8, -4].
    EXPECT_EQ(at(shadow, -6.0, 0.0)[0], 0);
    EXPECT_EQ(at(shadow, -2.0, 0.0)[0], 255);
    EXPECT_EQ(at(shadow, -6.0, 6.0)[0], 255);
    edit(masked)->alpha = scene::PhongMaterial::Alpha::opaque;
    EXPECT_EQ(at(factor(top, sun.node), -2.0, 0.0)[0], 0) << "without the mask all of it shadows";
}

TEST_F(MaterialGLTest, ATexturedSurfaceIsShadowedAsAPlainOne) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    edit(sun.core)->angle = 0.02F;
    const auto& painted = phong(vec3{0.8F});
    ground(sun.node, painted);
    caster(sun.node);
    const View top = view(topView(), 128, 128);
    const auto& white = texture(1, 1, {255, 255, 255, 255});
    for (const char* technique : {"std", "std+ppcf", "std+vsm", "std+gauss", "ray"}) {
        edit(top.viewport)->technique = technique;
        edit(painted)->diffuseMap = field::Ref<scene::Texture>{};
        const auto plain = factor(top, sun.node);
        const auto shown = picture(top);
        edit(painted)->diffuseMap = white;
        EXPECT_EQ(factor(top, sun.node).pixels, plain.pixels) << technique;
        EXPECT_EQ(picture(top).pixels, shown.pixels) << technique;
    }
}

TEST_F(MaterialGLTest, ABlendedSurfaceCastsNoneAndIsBlended) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    const auto& glass = phong(vec3{0.0F});
    {
        auto e = edit(glass);
        e->diffuse = math::vec4{1.0F, 0.0F, 0.0F, 0.25F};
        e->alpha = scene::PhongMaterial::Alpha::blend;
        e->unlit = true;
    }
    const auto& below = phong(vec3{0.0F});
    {
        auto e = edit(below);
        e->diffuse = math::vec4{0.0F, 0.4F, 0.0F, 1.0F};
        e->unlit = true;
    }
    ground(sun.node, below);
    add(paint(sun.node, glass).node,
        quad({-1.0F, 2.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}));
    const View top = view(topView(), 64, 64);
    expectClose(at(picture(top), 0.0, 0.0), {encoded(0.25), encoded(0.75 * 0.4), 0}, 1, "blended");
    EXPECT_EQ(at(factor(top, sun.node), 1.5, 0.0)[0], 255);
}

TEST_F(MaterialGLTest, AMirroredBoxIsThePictureOfTheBoxOnTheOtherSide) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.5}, {0.0, 0.0, 0.0});
    ground(sun.node, phong(vec3{0.8F}));
    const auto moved = transform(sun.node);
    const auto painted = paint(moved.node, phong(vec3{0.9F, 0.2F, 0.1F}));
    const auto& mesh =
        add(painted.node, box(vec3{-3.0F, 0.0F, -1.0F}, vec3{-1.0F, 2.0F, 1.0F}), true);
    const View seen = view(perspectiveView({3.0, 6.0, 9.0}, {0.0, 0.0, 0.0}), 128, 128);
    const auto direct = picture(seen);
    // The same box, modelled on the other side and mirrored back.
    math::Affine mirror;
    mirror.linear[0][0] = -1.0F;
    edit(moved.core)->matrix = mirror;
    const Mesh other = box(vec3{1.0F, 0.0F, -1.0F}, vec3{3.0F, 2.0F, 1.0F});
    {
        auto e = edit(mesh);
        e->positions = payloadOf(other.positions);
        e->boundsMin = vec3{1.0F, 0.0F, -1.0F};
        e->boundsMax = vec3{3.0F, 2.0F, 1.0F};
        auto chunk = mesh.chunks[0];
        chunk.min = mesh.boundsMin;
        chunk.max = mesh.boundsMax;
        e->chunks.set(0, chunk);
    }
    const auto mirrored = picture(seen);
    const auto difference = image::compare(direct, mirrored, 2);
    ASSERT_TRUE(difference.has_value());
    EXPECT_LE(difference->share, 0.001);
    edit(moved.core)->matrix = math::Affine{};
    EXPECT_GT(image::compare(direct, picture(seen), 2)->share, 0.05) << "the mirror did something";
}

TEST_F(MaterialGLTest, BackFacesAreSeenOfDoubleSidedMaterialsAlone) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    const auto& material = phong(vec3{1.0F});
    // Wound to face down.
    add(paint(sun.node, material).node,
        quad({-4.0F, 0.0F, -4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 8.0F}));
    const View top = view(topView(), 32, 32);
    EXPECT_EQ(at(picture(top), 0.0, 0.0), (Rgb{0, 0, 0}));
    edit(material)->doubleSided = true;
    EXPECT_GT(at(picture(top), 0.0, 0.0)[0], 200);
}

}  // namespace
}  // namespace gnomon::render
