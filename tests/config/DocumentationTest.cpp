#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "Walls.h"

namespace gnomon::config {
namespace {

// The keys of docs/config.md: a heading names the table, the first cell of a row the key.
std::set<std::string> documentedKeys() {
    std::istringstream text{fileText(GNOMON_SOURCE_DIR "/docs/config.md")};
    std::set<std::string> keys;
    std::string table;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("#")) {
            const auto from = line.find_first_not_of("#` [");
            const bool isTable = line.find('[') != std::string::npos;
            table = isTable ? line.substr(from, line.find(']') - from) + "." : std::string{};
        } else if (line.starts_with("| `")) {
            keys.insert(table + line.substr(3, line.find('`', 3) - 3));
        }
    }
    return keys;
}

TEST(Documentation, HasEveryKeyAndNoOther) {
    const std::vector<std::string> keys = knownKeys();
    EXPECT_EQ(documentedKeys(), (std::set<std::string>{keys.begin(), keys.end()}));
    EXPECT_GT(keys.size(), 40U);
}

TEST(Documentation, ItsExampleIsAWall) {
    const std::string text = fileText(GNOMON_SOURCE_DIR "/docs/config.md");
    const auto from = text.find("```toml\n");
    ASSERT_NE(from, std::string::npos);
    const auto to = text.find("```", from + 8);
    const Inspection inspection = inspectConfig(text.substr(from + 8, to - from - 8), "config.md");
    EXPECT_EQ(allText(inspection.findings), "");
}

}  // namespace
}  // namespace gnomon::config
