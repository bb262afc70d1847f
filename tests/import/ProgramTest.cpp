#include <fcntl.h>
#include <gnomon/base/Process.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "Model.h"
#include "ProgramRun.h"
#include "program/Options.h"

namespace gnomon::importer {
namespace {

TEST(ImportProgram, WritesToAPath) {
    const TemporaryFolder folder;
    GltfWriter writer;
    writer.mesh(cube());
    writer.node({{"mesh", 0}});
    const auto file = folder.write("a.glb", writer.glb());
    const auto out = folder.path() / "out.bin";
    const auto run = runImporter({file.string(), "--output", out.string()});
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    std::ifstream stream{out, std::ios::binary};
    std::string head(4, ' ');
    stream.read(head.data(), 4);
    EXPECT_EQ(head, "GNIM");
}

TEST(ImportProgram, RefusesWithOneLineThatNamesTheFile) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.glb", "glTF");
    const auto run = runImporter({file.string(), "--output", "-"});
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.errors.rfind(file.string() + ": ", 0), 0U) << run.errors;
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1);
    EXPECT_EQ(run.outputBytes, 0U);
}

TEST(ImportProgram, RefusesWhatIsNoRegularFile) {
    const TemporaryFolder folder;
    for (const std::string& file : {std::string{"/dev/zero"}, folder.path().string(),
                                    (folder.path() / "none.glb").string()}) {
        const auto run = runImporter({file, "--output", "-"});
        EXPECT_EQ(run.code, 1) << file;
        EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
    }
}

TEST(ImportProgram, SaysHowItIsUsed) {
    EXPECT_EQ(runImporter({}).code, 2);
    EXPECT_EQ(runImporter({"a.glb"}).code, 2);
    EXPECT_EQ(runImporter({"a.glb", "--output"}).code, 2);
    EXPECT_EQ(runImporter({"a.glb", "--output", "-", "--max-memory", "lots"}).code, 2);
    EXPECT_EQ(runImporter({"a.glb", "--output", "-", "--fast"}).code, 2);
    EXPECT_EQ(runImporter({"--help"}).code, 0);
}

TEST(ImportProgram, ReportsProgressOnlyWhereAsked) {
    const TemporaryFolder folder;
    GltfWriter writer;
    writer.mesh(cube());
    writer.node({{"mesh", 0}});
    const auto file = folder.write("a.glb", writer.glb());
    const auto run = runImporter({file.string(), "--output", "-", "--progress"});
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.errors.find("@progress 0.000 mesh 0\n"), std::string::npos) << run.errors;
}

}  // namespace
}  // namespace gnomon::importer
