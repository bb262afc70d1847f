#include <gnomon/base/Error.h>
#include <gtest/gtest.h>

#include <set>

namespace gnomon {
namespace {

Result<int> half(int value) {
    if (value % 2 != 0) return fail(Errc::limit, std::to_string(value) + " is odd");
    return value / 2;
}

Result<void> check(bool good) {
    if (!good) return fail(Errc::file, "not good", std::make_error_code(std::errc::io_error));
    return {};
}

TEST(Error, EveryCodeHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (int code = 0; code <= static_cast<int>(Errc::process); ++code)
        EXPECT_TRUE(names.insert(name(static_cast<Errc>(code))).second) << code;
    EXPECT_FALSE(names.contains("unknown"));
    EXPECT_EQ(name(static_cast<Errc>(200)), "unknown");
}

TEST(Error, CarriesCodeSentenceAndTheSystemsReason) {
    EXPECT_EQ(half(4).value(), 2);
    const auto odd = half(3);
    ASSERT_FALSE(odd.has_value());
    EXPECT_EQ(odd.error().code, Errc::limit);
    EXPECT_EQ(odd.error().text(), "3 is odd");
    const auto bad = check(false);
    ASSERT_FALSE(bad.has_value());
    EXPECT_EQ(bad.error().text(),
              "not good: " + std::make_error_code(std::errc::io_error).message());
}

TEST(Error, OrThrowReturnsOrThrowsWhatItIs) {
    EXPECT_EQ(orThrow(half(8)), 4);
    orThrow(check(true));
    try {
        orThrow(half(5));
        FAIL() << "nothing was thrown";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().code, Errc::limit);
        EXPECT_STREQ(failure.what(), "5 is odd");
    }
    EXPECT_THROW(orThrow(check(false)), Failure);
}

TEST(ErrorDeathTest, ABrokenContractNamesItself) {
    const auto expectsTwo = [](int value) { GNOMON_EXPECTS(value == 2, "two are needed"); };
    expectsTwo(2);
    EXPECT_DEATH(expectsTwo(3), "ErrorTest.cpp.*broken contract: two are needed .value == 2.");
}

}  // namespace
}  // namespace gnomon
