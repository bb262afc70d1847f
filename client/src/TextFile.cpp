#include "TextFile.h"

#include <gnomon/base/Error.h>

#include <fstream>

namespace gnomon::client {

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out{file};
    out << text;
    out.close();
    if (!out) throw Failure{Errc::file, "cannot write " + file.string()};
}

void makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Failure{Errc::file, "cannot make " + folder.string() + ": " + error.message()};
}

}  // namespace gnomon::client
