#include <GLTest.h>
#include <gnomon/gl/Handle.h>

#include <string>
#include <utility>
#include <vector>

namespace gnomon::gl {
namespace {

using HandleGLTest = GLTest;

TEST_F(HandleGLTest, EveryKindIsMadeLabelledAndDestroyed) {
    const auto check = [](const auto& handle, GLenum identifier) {
        ASSERT_TRUE(handle);
        handle.label("of this test");
        char text[32] = {};
        gl().GetObjectLabel(identifier, handle.id(), 32, nullptr, text);
        EXPECT_EQ(std::string{text}, "of this test");
    };
    check(Buffer{gl()}, GL_BUFFER);
    check(Texture{gl(), GL_TEXTURE_2D_ARRAY}, GL_TEXTURE);
    check(Sampler{gl()}, GL_SAMPLER);
    check(Framebuffer{gl()}, GL_FRAMEBUFFER);
    check(Renderbuffer{gl()}, GL_RENDERBUFFER);
    check(VertexArray{gl()}, GL_VERTEX_ARRAY);
    check(Program{gl()}, GL_PROGRAM);
    check(Shader{gl(), GL_VERTEX_SHADER}, GL_SHADER);
    check(Query{gl(), GL_TIME_ELAPSED}, GL_QUERY);
}

TEST_F(HandleGLTest, ATextureLivesAsLongAsItsHandle) {
    GLuint id = 0;
    {
        Texture first{gl(), GL_TEXTURE_2D};
        id = first.id();
        const Texture second{std::move(first)};
        EXPECT_EQ(second.id(), id);
        EXPECT_TRUE(gl().IsTexture(id));
    }
    EXPECT_FALSE(gl().IsTexture(id));
}

TEST_F(HandleGLTest, ATextureWithoutATargetCanBecomeAView) {
    const Texture whole{gl(), GL_TEXTURE_2D_ARRAY};
    gl().TextureStorage3D(whole.id(), 1, GL_RGBA8, 4, 4, 3);
    const Texture layer{gl()};
    gl().TextureView(layer.id(), GL_TEXTURE_2D, whole.id(), GL_RGBA8, 0, 1, 2, 1);
    EXPECT_TRUE(gl().IsTexture(layer.id()));
}

// No context below: a table that counts what is destroyed.

std::vector<GLuint>& destroyed() {
    static std::vector<GLuint> ids;
    return ids;
}

Api countingApi() {
    destroyed().clear();
    Api api;
    api.CreateBuffers = [](GLsizei, GLuint* id) {
        static GLuint last = 0;
        *id = ++last;
    };
    api.DeleteBuffers = [](GLsizei, const GLuint* id) { destroyed().push_back(*id); };
    api.GetString = [](GLenum) { return reinterpret_cast<const GLubyte*>("4.5"); };
    return api;
}

TEST(Handle, DestroysOnceHoweverOftenItMoves) {
    const Api api = countingApi();
    GLuint id = 0;
    {
        Buffer a{api};
        id = a.id();
        Buffer b{std::move(a)};
        Buffer c;
        c = std::move(b);
        EXPECT_EQ(c.id(), id);
        EXPECT_FALSE(a);  // NOLINT(bugprone-use-after-move): moved-from is empty by contract
        EXPECT_FALSE(b);  // NOLINT(bugprone-use-after-move)
        EXPECT_TRUE(destroyed().empty());
    }
    EXPECT_EQ(destroyed(), std::vector<GLuint>{id});
}

TEST(Handle, AssignmentDestroysWhatWasThere) {
    const Api api = countingApi();
    Buffer a{api};
    Buffer b{api};
    const auto old = a.id();
    const auto kept = b.id();
    a = std::move(b);
    EXPECT_EQ(destroyed(), std::vector<GLuint>{old});
    EXPECT_EQ(a.id(), kept);
    auto& same = a;
    a = std::move(same);
    EXPECT_EQ(a.id(), kept);
    EXPECT_EQ(a.release(), kept);
}

TEST(Handle, ReleasedOrEmptyHandlesDestroyNothing) {
    const Api api = countingApi();
    {
        Buffer a{api};
        EXPECT_NE(a.release(), 0U);
        a.reset();
        const Buffer empty;
        EXPECT_EQ(empty.id(), 0U);
    }
    EXPECT_TRUE(destroyed().empty());
}

TEST(HandleDeathTest, StopsWhenItsContextIsNotCurrent) {
#ifdef NDEBUG
    GTEST_SKIP() << "the check is in debug builds only";
#else
    Api api = countingApi();
    Buffer buffer{api};
    // What every driver answers without a current context.
    api.GetString = [](GLenum) -> const GLubyte* { return nullptr; };
    EXPECT_DEATH(buffer.reset(), "its context is not current");
    EXPECT_NE(buffer.release(), 0U);
#endif
}

}  // namespace
}  // namespace gnomon::gl
