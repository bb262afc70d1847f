#pragma once

#include <gnomon/gl/Context.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace gnomon::gl {

/// Fails the running test once for each complaint of the debug context since the last look.
inline void failOnDebugErrors(Context& context) {
    for (const auto& message : context.takeDebugErrors()) ADD_FAILURE() << message;
}

/// A fixture with a current debug context, shared by the tests of one process. A test fails when
/// OpenGL reports an error in it; one that provokes errors takes them from context() itself.
/// GNOMON_TEST_BACKEND chooses another back end than egl for the whole process.
class GLTest : public testing::Test {
protected:
    void SetUp() override {
        auto& made = shared();
        ASSERT_TRUE(made) << made.error().text();
        (*made)->makeCurrent();
        (*made)->takeDebugErrors();
    }

    void TearDown() override {
        if (!shared()) return;
        context().api().Finish();
        failOnDebugErrors(context());
    }

    static Context& context() { return **shared(); }
    static const Api& gl() { return context().api(); }

private:
    static Result<std::unique_ptr<Context>>& shared() {
        static auto made = make();
        return made;
    }
    static Result<std::unique_ptr<Context>> make() {
        const char* word = std::getenv("GNOMON_TEST_BACKEND");
        const auto backend = parseBackend(word != nullptr ? word : "egl");
        if (!backend) return tl::unexpected{backend.error()};
        return createContext({.backend = *backend, .debug = true});
    }
};

}  // namespace gnomon::gl
