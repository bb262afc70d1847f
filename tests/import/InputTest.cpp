#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "Model.h"
#include "gltf/Json.h"
#include "input/Files.h"
#include "input/Report.h"
#include "input/Text.h"
#include "input/Uri.h"

namespace gnomon::importer {
namespace {

class SideFiles : public testing::Test {
protected:
    SideFiles() {
        outside_ = folder_.write("secret.txt", "secret");
        model_ = folder_.write("model/scene.gltf", "{}");
        folder_.write("model/a b.bin", "inside");
        folder_.write("model/sub/deep.bin", "deep");
    }
    std::string read(const std::string& uri) {
        Folder folder{model_};
        const auto got = readUri(uri, folder);
        return got ? std::string{asText(**got)} : "! " + got.error().text();
    }
    TemporaryFolder folder_;
    std::filesystem::path model_, outside_;
};

TEST_F(SideFiles, AreReadBelowTheModelsFolder) {
    EXPECT_EQ(read("a%20b.bin"), "inside");
    EXPECT_EQ(read("a b.bin"), "inside");
    EXPECT_EQ(read("./sub/deep.bin"), "deep");
    EXPECT_EQ(read("sub//deep.bin"), "deep");
}

TEST_F(SideFiles, AreReadNowhereElse) {
    std::filesystem::create_symlink(outside_, model_.parent_path() / "link.txt");
    ASSERT_EQ(::mkfifo((model_.parent_path() / "pipe").c_str(), 0600), 0);
    const std::string absolute = outside_.string();
    for (const std::string& uri :
         {std::string{"../secret.txt"}, std::string{"sub/../../secret.txt"},
          std::string{"%2e%2e/secret.txt"}, std::string{"..%2fsecret.txt"}, absolute,
          "file://" + absolute, "//host" + absolute, "%2f" + absolute.substr(1),
          std::string{"http://127.0.0.1:9/x"}, std::string{"link.txt"},
          std::string{"a b.bin\0.png", 12}, std::string{"a%20b.bin%00.png"},
          std::string{"/dev/zero"}, std::string{"sub"}, std::string{"pipe"}, std::string{"."},
          std::string{""}, std::string{"%zz"}, std::string{"missing.bin"}}) {
        const auto got = read(uri);
        EXPECT_EQ(got.substr(0, 2), "! ") << uri << " -> " << got;
        EXPECT_EQ(got.find('\n'), std::string::npos);
    }
}

TEST_F(SideFiles, AreReadOnceEach) {
    Folder folder{model_};
    const auto first = folder.read("a b.bin");
    const auto second = folder.read("./a b.bin");
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->get(), second->get());
}

TEST(Uri, DecodesBase64) {
    const auto text = [](std::string_view encoded) {
        const auto bytes = base64Decoded(encoded);
        return bytes ? std::string{asText(*bytes)} : "! " + bytes.error().text();
    };
    EXPECT_EQ(text(""), "");
    EXPECT_EQ(text("Zg=="), "f");
    EXPECT_EQ(text("Zm8="), "fo");
    EXPECT_EQ(text("Zm9v"), "foo");
    EXPECT_EQ(text("Zm9vYmFy"), "foobar");
    EXPECT_EQ(text("Zm8"), "fo");
    EXPECT_EQ(text("_-8="), "\xff\xef");
    for (const auto* bad : {"Z", "Zm9v\n", "Zm=v", "@@@@", "Zm9vY"})
        EXPECT_EQ(text(bad).substr(0, 2), "! ") << bad;
}

TEST(Text, ReadsNumbersStrictly) {
    EXPECT_EQ(parsedNumber("1.5"), 1.5);
    EXPECT_EQ(parsedNumber("+2."), 2.0);
    EXPECT_EQ(parsedNumber("-1e3"), -1000.0);
    EXPECT_EQ(parsedNumber("1e999"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(parsedNumber("1e-999"), 0.0);
    EXPECT_TRUE(std::isnan(parsedNumber("nan").value_or(0.0)));
    for (const auto* bad : {"", "+", "-", "1,5", "3.1+e2", "1.5x", "0x10", "--1", "e5"})
        EXPECT_FALSE(parsedNumber(bad)) << bad;
    EXPECT_EQ(parsedInteger("-12"), -12);
    EXPECT_FALSE(parsedInteger("1.0"));
    EXPECT_FALSE(parsedInteger("99999999999999999999"));
}

TEST(Text, SplitsIntoLinesAndJoinsContinuedOnes) {
    Lines lines{"a\r\nb \\\nc\n\nd"};
    std::string_view line;
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line, "a");
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line, "b  c ");
    EXPECT_EQ(lines.number(), 2U);
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line, "");
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line, "d");
    EXPECT_EQ(lines.number(), 5U);
    EXPECT_FALSE(lines.next(line));
}

TEST(Json, RefusesDeepNestingBeforeItIsParsed) {
    const auto nested = [](std::size_t depth) {
        return "{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}";
    };
    EXPECT_NO_THROW(parsedJson(nested(maxJsonDepth - 1)));
    EXPECT_THROW(parsedJson(nested(maxJsonDepth)), Failure);
    EXPECT_THROW(parsedJson(nested(1000000)), Failure);
    EXPECT_THROW(parsedJson(std::string(1000000, '[')), Failure);
    EXPECT_NO_THROW(parsedJson("{\"a\":\"" + std::string(1000, '[') + "\\\"{{{\"}"));
}

TEST(Json, SaysWhatIsWrongAndWhere) {
    const auto json =
        parsedJson(R"({"n": -1, "f": 1.5, "w": 5.0, "s": "x", "big": 1e300, "list": [1, 2, "3"]})");
    const JsonView view{json, "thing 7"};
    const auto why = [](auto&& action) {
        try {
            action();
        } catch (const Failure& failure) {
            return std::string{failure.what()};
        }
        return std::string{};
    };
    EXPECT_EQ(why([&] { view.unsignedInteger("n"); }),
              "thing 7: n is -1, expected a whole number >= 0");
    EXPECT_NE(why([&] { view.unsignedInteger("f"); }), "");
    EXPECT_NE(why([&] { view.unsignedInteger("big"); }), "");
    EXPECT_EQ(view.unsignedInteger("w"), 5U);
    EXPECT_FALSE(view.unsignedInteger("absent"));
    EXPECT_EQ(why([&] { view.index("w", 5, "nodes"); }), "thing 7: w is 5, but there are 5 nodes");
    EXPECT_EQ(view.index("w", 6, "nodes"), 5U);
    EXPECT_EQ(why([&] { view.number("s"); }), "thing 7: s is \"x\", expected a number");
    std::array<double, 3> three{};
    EXPECT_NE(why([&] { view.numbers("list", three); }), "");
    EXPECT_NE(why([&] { view.object("list"); }), "");
    EXPECT_NE(why([&] { view.objects("list"); }), "");
}

TEST(Report, KeepsEqualWarningsOnceAndCountsWhatIsTooMuch) {
    Report report;
    for (int i = 0; i < 3; ++i) report.warn("the same");
    EXPECT_EQ(report.warnings().size(), 1U);
    for (std::size_t i = 0; i < 2 * Report::maxWarnings; ++i) report.warn(std::to_string(i));
    EXPECT_EQ(report.warnings().size(), Report::maxWarnings + 1);
    EXPECT_EQ(report.warnings().back(), "and 101 more warnings");
}

TEST(Report, MakesTextFitForOneLine) {
    EXPECT_EQ(printable("a\nb\x1b[31m\x7f"), "a?b?[31m?");
    EXPECT_EQ(printable("abcdef", 3), "abc...");
    EXPECT_EQ(printable("Ma\u00dfe \u65e5\U0001f600"), "Ma\u00dfe \u65e5\U0001f600");
    EXPECT_EQ(printable("\u65e5\u65e5", 4), "\u65e5...");  // characters are cut whole
    EXPECT_EQ(printable("\xff\xc0\xaf\xed\xa0\x80\xe6\x97"), "????????");
}

}  // namespace
}  // namespace gnomon::importer
