// The registry of filters.
#include <gnomon/shadow/Filter.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon::shadow {
namespace {

TEST(Filters, EachSaysWhereItIsFromAndDefinesTheLookup) {
    ASSERT_FALSE(filters().empty());
    std::string_view before;
    for (const FilterInfo& info : filters()) {
        EXPECT_LT(before, info.name) << "sorted, and each name once";
        before = info.name;
        EXPECT_FALSE(info.source.empty()) << info.name;
        EXPECT_NE(info.glsl.find("float filteredShadow(int first, ShadowPoint point)"),
                  std::string_view::npos);
        EXPECT_GE(info.leastTexels, 0.5F);
        EXPECT_EQ(findFilter(info.name)->glsl, info.glsl);
    }
    EXPECT_NE(findFilter("hard"), nullptr) << "the default";
    EXPECT_EQ(findFilter("no such filter"), nullptr);
    EXPECT_EQ(findFilter(""), nullptr);
}

}  // namespace
}  // namespace gnomon::shadow
