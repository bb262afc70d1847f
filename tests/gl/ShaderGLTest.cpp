#include <GLTest.h>
#include <gnomon/gl/Shader.h>

#include <array>
#include <string>
#include <vector>

namespace gnomon::gl {
namespace {

constexpr std::string_view version = "#version 450 core\n";
constexpr std::string_view triangle = R"glsl(
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
)glsl";

class ShaderGLTest : public GLTest {
protected:
    static Result<Program> build(std::string_view label, std::string_view vertex,
                                 std::string_view fragment) {
        const std::array stages{
            ShaderStage{.type = GL_VERTEX_SHADER, .parts = {version, vertex}},
            ShaderStage{.type = GL_FRAGMENT_SHADER, .parts = {version, fragment}}};
        return buildProgram(gl(), label, stages);
    }
    static void expectPart(const Error& error, std::string_view part) {
        EXPECT_EQ(error.code, Errc::shader);
        EXPECT_NE(error.what.find(part), std::string::npos)
            << "\"" << part << "\" is not in: " << error.what;
    }
};

TEST_F(ShaderGLTest, ABuiltProgramDrawsAndIsLabelled) {
    const auto program = build("uniform colour", triangle,
                               "uniform vec4 colour;\nout vec4 result;\n"
                               "void main() { result = colour; }\n");
    ASSERT_TRUE(program) << program.error().text();
    char label[32] = {};
    gl().GetObjectLabel(GL_PROGRAM, program->id(), 32, nullptr, label);
    EXPECT_EQ(std::string{label}, "uniform colour");

    const Texture target{gl(), GL_TEXTURE_2D};
    gl().TextureStorage2D(target.id(), 1, GL_RGBA8, 8, 8);
    const Framebuffer framebuffer{gl()};
    gl().NamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, target.id(), 0);
    const VertexArray nothing{gl()};
    gl().ProgramUniform4f(program->id(), gl().GetUniformLocation(program->id(), "colour"), 1.0F,
                          0.6F, 0.2F, 0.0F);
    gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl().Viewport(0, 0, 8, 8);
    gl().BindVertexArray(nothing.id());
    gl().UseProgram(program->id());
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
    gl().UseProgram(0);
    gl().BindVertexArray(0);
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);

    std::vector<GLubyte> pixels(std::size_t{8} * 8 * 4);
    gl().GetTextureImage(target.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                         static_cast<GLsizei>(pixels.size()), pixels.data());
    for (std::size_t i = 0; i < pixels.size(); i += 4)
        ASSERT_EQ(std::vector<GLubyte>(pixels.begin() + static_cast<std::ptrdiff_t>(i),
                                       pixels.begin() + static_cast<std::ptrdiff_t>(i) + 4),
                  (std::vector<GLubyte>{255, 153, 51, 0}));
}

TEST_F(ShaderGLTest, ACompileErrorNamesLabelStageAndLine) {
    const auto program = build("broken paint", triangle,
                               "out vec4 result;\nvoid main() {\n    result = vec4(colour);\n}\n");
    ASSERT_FALSE(program);
    expectPart(program.error(),
               "shader program \"broken paint\": fragment shader does not compile");
    expectPart(program.error(), "colour");  // what the driver found undeclared
    expectPart(program.error(), "\n    line 4:     result = vec4(colour);");
}

TEST_F(ShaderGLTest, AfterALineDirectiveNoSourceIsQuoted) {
    const auto program = build("renumbered", triangle,
                               "#line 100\nout vec4 result;\nvoid main() { result = colour; }\n");
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().what.find("\n    line "), std::string::npos) << program.error().what;
    expectPart(program.error(), "101");
}

TEST_F(ShaderGLTest, ALinkErrorNamesLabelAndStages) {
    const auto program =
        build("mismatch", "out vec2 place;\nvoid main() { place = vec2(0.0); }\n",
              "in vec4 place;\nout vec4 result;\nvoid main() { result = place; }\n");
    ASSERT_FALSE(program);
    expectPart(program.error(),
               "shader program \"mismatch\": vertex shader + fragment shader do not link:");
    expectPart(program.error(), "place");
}

TEST_F(ShaderGLTest, AnUnknownStageIsAnError) {
    const std::array stages{ShaderStage{.type = GL_TEXTURE_2D, .parts = {version}}};
    const auto program = buildProgram(gl(), "odd", stages);
    ASSERT_FALSE(program);
    expectPart(program.error(), "is not a shader type");
    EXPECT_EQ(context().takeDebugErrors().size(), 1U);  // the driver says so too
}

}  // namespace
}  // namespace gnomon::gl
