#include <GLTest.h>
#include <gtest/gtest-spi.h>

#include <string>

namespace gnomon::gl {
namespace {

using ContextGLTest = GLTest;

constexpr GLuint noSuchTexture = 4711;

TEST_F(ContextGLTest, AMistakeIsCollectedOnce) {
    gl().BindTextureUnit(0, noSuchTexture);
    const auto messages = context().takeDebugErrors();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_NE(messages[0].find("glBindTextureUnit"), std::string::npos) << messages[0];
    EXPECT_TRUE(context().takeDebugErrors().empty());
}

TEST_F(ContextGLTest, AMistakeFailsTheTestThatMadeIt) {
    gl().BindTextureUnit(0, noSuchTexture);
    EXPECT_NONFATAL_FAILURE(failOnDebugErrors(context()), "glBindTextureUnit");
}

TEST_F(ContextGLTest, HighSeverityCountsAndLowDoesNot) {
    const auto say = [](GLenum severity, const char* text) {
        gl().DebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 7, severity,
                                -1, text);
    };
    say(GL_DEBUG_SEVERITY_NOTIFICATION, "small talk");
    say(GL_DEBUG_SEVERITY_HIGH, "slow path");
    const auto messages = context().takeDebugErrors();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0], "OpenGL application 7: slow path");
}

TEST_F(ContextGLTest, AFloodOfMistakesIsCountedNotStored) {
    for (int i = 0; i < 150; ++i) gl().BindTextureUnit(0, noSuchTexture);
    const auto messages = context().takeDebugErrors();
    ASSERT_EQ(messages.size(), 101U);
    EXPECT_EQ(messages.back(), "... and 50 more");
}

TEST_F(ContextGLTest, ExtensionsAreFoundByTheirWholeName) {
    const auto* first = gl().GetStringi(GL_EXTENSIONS, 0);
    ASSERT_NE(first, nullptr);
    const std::string known = reinterpret_cast<const char*>(first);
    EXPECT_TRUE(hasExtension(gl(), known));
    EXPECT_FALSE(hasExtension(gl(), known.substr(0, known.size() - 1)));
}

TEST_F(ContextGLTest, ALabelLongerThanTheDriverTakesIsCut) {
    const GLuint id = [] {
        GLuint made = 0;
        gl().CreateBuffers(1, &made);
        return made;
    }();
    setLabel(gl(), GL_BUFFER, id, std::string(100000, 'x'));
    GLsizei length = 0;
    char text[4] = {};
    gl().GetObjectLabel(GL_BUFFER, id, 4, &length, text);
    EXPECT_EQ(std::string{text}, "xxx");
    gl().DeleteBuffers(1, &id);
}

// No context below: the loader gets stand-ins for entry points.

void anyFunction() {}

TEST(LoadApi, NamesTheFunctionThatIsMissing) {
    const auto loaded = loadApi([](const char* name) -> Procedure {
        return std::string_view{name} == "glClearTexImage" ? nullptr : &anyFunction;
    });
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, Errc::context);
    EXPECT_NE(loaded.error().what.find("glClearTexImage"), std::string::npos)
        << loaded.error().what;
}

void APIENTRY getIntegerOfAnOldContext(GLenum what, GLint* value) {
    *value = what == GL_MAJOR_VERSION ? 4 : 3;
}

TEST(LoadApi, RefusesAnOlderVersion) {
    const auto loaded = loadApi([](const char* name) -> Procedure {
        return std::string_view{name} == "glGetIntegerv"
                   ? reinterpret_cast<Procedure>(&getIntegerOfAnOldContext)
                   : &anyFunction;
    });
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().what.find("the context is 4.3, 4.5 or later is needed"),
              std::string::npos)
        << loaded.error().what;
}

}  // namespace
}  // namespace gnomon::gl
