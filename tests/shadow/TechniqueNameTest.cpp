// The words that choose a technique.
#include <gnomon/shadow_fit/Fit.h>
#include <gtest/gtest.h>

#include <array>

namespace gnomon::shadow_fit {
namespace {

constexpr std::array<std::string_view, 3> filters{"hard", "pcf", "vsm"};

TEST(TechniqueName, IsAFitAndAFilter) {
    struct Case {
        std::string_view text, fit, filter;
    };
    for (const Case& c :
         {Case{"std", "std", "hard"}, Case{"std+pcf", "std", "pcf"}, Case{"pcf", "std", "pcf"},
          Case{"vsm", "std", "vsm"}, Case{"std+hard", "std", "hard"}}) {
        const auto name = parseTechnique(c.text, filters);
        ASSERT_TRUE(name.has_value()) << name.error().text();
        EXPECT_EQ(name->fit, c.fit);
        EXPECT_EQ(name->filter, c.filter);
        EXPECT_FALSE(name->none());
    }
    EXPECT_TRUE(parseTechnique("none", filters)->none());
}

TEST(TechniqueName, WrongOnesAreToldWhatWouldDo) {
    for (const std::string_view text : {"", "nonsense", "std+", "std+nonsense", "+pcf", "pcf+std",
                                        "std+pcf+vsm", "none+pcf", "STD"}) {
        const auto name = parseTechnique(text, filters);
        ASSERT_FALSE(name.has_value()) << text;
        EXPECT_EQ(name.error().code, Errc::config);
        EXPECT_NE(name.error().what.find("\"" + std::string{text} + "\""), std::string::npos)
            << name.error().what;
        const bool saysFits = name.error().what.find("std") != std::string::npos;
        EXPECT_TRUE(saysFits) << name.error().what;
    }
    const auto filter = parseTechnique("std+nonsense", filters);
    EXPECT_NE(filter.error().what.find("hard pcf vsm"), std::string::npos) << filter.error().what;
}

TEST(TechniqueName, EveryFitHasASourceAndIsFound) {
    ASSERT_FALSE(fits().empty());
    std::string_view before;
    for (const FitInfo& info : fits()) {
        EXPECT_LT(before, info.name) << "sorted, and each name once";
        before = info.name;
        EXPECT_FALSE(info.source.empty()) << info.name;
        EXPECT_NE(info.fit, nullptr);
        EXPECT_EQ(parseTechnique(info.name, filters)->fit, info.name);
    }
}

}  // namespace
}  // namespace gnomon::shadow_fit
