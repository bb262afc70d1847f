#include <gnomon/import/Import.h>
#include <gnomon/scene/Types.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "Model.h"
#include "ProgramRun.h"
#include "format/Sanitizer.h"

namespace gnomon::importer {
namespace {

class ImportClient : public testing::Test {
protected:
    ImportClient() {
        GltfWriter writer;
        writer.mesh(sphere(32, 16));
        writer.node({{"mesh", 0}, {"name", "ball"}});
        good_ = folder_.write("good.glb", writer.glb());
        options_.program = GNOMON_BIN_DIR "/gnomon-import";
    }
    /// A program in the importer's place.
    void pretend(const std::string& script) {
        options_.program = folder_.write("fake.sh", "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(options_.program, std::filesystem::perms::owner_all);
    }
    /// A program that sends what the real one sent, after @p change.
    template <class Change>
    void pretendStream(Change&& change) {
        const auto real = folder_.path() / "real.bin";
        ASSERT_EQ(runImporter({good_.string(), "--output", real.string()}).code, 0);
        std::ifstream in{real, std::ios::binary};
        std::string bytes{std::istreambuf_iterator<char>{in}, {}};
        change(bytes);
        const auto path = folder_.write("stream.bin", bytes);
        pretend("exec cat '" + path.string() + "'");
    }
    Error failure() {
        auto list = importScene(good_, options_);
        EXPECT_FALSE(list.has_value());
        return list ? Error{} : list.error();
    }
    const TemporaryFolder folder_;
    std::filesystem::path good_;
    ImportOptions options_;
};

TEST_F(ImportClient, GetsWhatCanBeAdopted) {
    std::vector<double> shares;
    options_.progress = [&](double share, const std::string&) { shares.push_back(share); };
    const auto list = importScene(good_, options_);
    ASSERT_TRUE(list) << list.error().text();
    const Model model{*list};
    EXPECT_EQ(model.imported().trianglesDrawn, sphere(32, 16).triangles());
    EXPECT_EQ(model.imported().source.get(), "good.glb");
    EXPECT_EQ(faultsOf(*model.all<scene::Geometry>().front()), "");
    EXPECT_FALSE(shares.empty());
}

TEST_F(ImportClient, TakesTheProgramFromTheEnvironment) {
    options_.program.clear();
    ::setenv("GNOMON_IMPORT", "/does/not/exist", 1);
    EXPECT_EQ(failure().code, Errc::process);
    ::unsetenv("GNOMON_IMPORT");
    EXPECT_TRUE(importScene(good_, options_));  // next to this program
}

TEST_F(ImportClient, PassesOnWhyAFileIsRefused) {
    good_ = folder_.write("bad.glb", "glTF");
    const auto error = failure();
    EXPECT_EQ(error.code, Errc::file);
    EXPECT_EQ(error.what,
              good_.string() + ": GLB header: the file has 4 bytes, expected at least 12");
}

TEST_F(ImportClient, TellsACrashFromAKill) {
    pretend("kill -SEGV $$");
    auto error = failure();
    EXPECT_EQ(error.code, Errc::file);
    EXPECT_NE(error.what.find("good.glb: the importer crashed (signal 11"), std::string::npos)
        << error.what;
    EXPECT_NE(error.what.find("probably malformed"), std::string::npos);
    pretend("kill -KILL $$");
    error = failure();
    EXPECT_EQ(error.code, Errc::limit);
    EXPECT_NE(error.what.find("memory"), std::string::npos) << error.what;
}

TEST_F(ImportClient, StopsAnImporterThatTakesTooLong) {
    options_.maxTime = std::chrono::seconds{1};
    for (const char* script :
         {"exec sleep 60", "while :; do echo @progress 0.5 still at it >&2; done",
          "exec cat /dev/zero >&2", "exec >&-; exec sleep 60"}) {
        pretend(script);
        const auto start = std::chrono::steady_clock::now();
        const auto error = failure();
        EXPECT_EQ(error.code, Errc::limit) << script << ": " << error.what;
        EXPECT_NE(error.what.find("longer than 1 s"), std::string::npos) << error.what;
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{10});
    }
}

TEST_F(ImportClient, StopsAnImportThatNeedsTooMuchMemory) {
    if (reservesAddressSpace)
        GTEST_SKIP() << "sanitizers reserve the address space that is limited";
    Shape many;
    for (int i = 0; i < 200; ++i) many.add(sphere(64, 32), {static_cast<float>(i), 0.0F, 0.0F});
    GltfWriter writer;
    writer.mesh(many);
    writer.node({{"mesh", 0}});
    good_ = folder_.write("large.glb", writer.glb());
    EXPECT_TRUE(importScene(good_, options_));
    options_.maxMemory = std::uint64_t{40} << 20U;  // the program alone needs most of it
    const auto error = failure();
    EXPECT_NE(error.what.find("memory"), std::string::npos) << error.what;
}

TEST_F(ImportClient, NoticesEveryKindOfDamage) {
    pretendStream([](std::string&) {});
    EXPECT_TRUE(importScene(good_, options_));
    const auto damaged = [&](const char* what, auto&& change) {
        pretendStream(change);
        const auto error = failure();
        EXPECT_EQ(error.code, Errc::protocol) << what << ": " << error.what;
        EXPECT_NE(error.what.find("good.glb: "), std::string::npos) << error.what;
    };
    damaged("magic", [](std::string& b) { b[0] = 'X'; });
    damaged("version", [](std::string& b) { b[4] = static_cast<char>(b[4] + 1); });
    damaged("more behind the end", [](std::string& b) { b.push_back('X'); });
    damaged("types", [](std::string& b) { b[9] = static_cast<char>(b[9] + 1); });
    damaged("cut in the header", [](std::string& b) { b.resize(20); });
    damaged("cut in the list", [](std::string& b) { b.resize(100); });
    damaged("cut at the end", [](std::string& b) { b.pop_back(); });
    damaged("payload",
            [](std::string& b) { b[b.size() - 20] = static_cast<char>(b[b.size() - 20] + 1); });
    damaged("nothing", [](std::string& b) { b.clear(); });
    damaged("number of payloads", [](std::string& b) { b[40] = static_cast<char>(b[40] + 1); });
    pretend("exec cat /dev/urandom");
    EXPECT_EQ(failure().code, Errc::protocol);
    pretend("exit 3");
    EXPECT_EQ(failure().code, Errc::process);
}

TEST_F(ImportClient, AllocatesOnlyWhatArrives) {
    pretendStream([](std::string& b) {
        for (std::size_t at = 24; at < 40; ++at) b[at] = '\xff';
    });
    EXPECT_EQ(failure().code, Errc::limit);
    pretendStream([](std::string& b) {
        const std::uint64_t claimed = std::uint64_t{3} << 30U;
        std::memcpy(b.data() + 24, &claimed, 8);
    });
    EXPECT_EQ(failure().code, Errc::protocol);  // ends early
}

}  // namespace
}  // namespace gnomon::importer
