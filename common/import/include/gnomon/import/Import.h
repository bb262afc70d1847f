#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/ChangeList.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace gnomon::importer {

struct ImportOptions {
    /// The importer program; empty: $GNOMON_IMPORT, else gnomon-import next to the running program.
    std::filesystem::path program = {};
    /// Address space of the importer process, and the most that its result may hold, bytes.
    std::uint64_t maxMemory = std::uint64_t{4} << 30U;
    std::chrono::seconds maxTime{60};
    /// Called now and then, on the calling thread: how far it is (0..1), and with what.
    std::function<void(double share, const std::string& what)> progress = {};
};

/// Reads a model file in a process of its own, so that a hostile or broken file harms nobody.
///
/// What comes back is made in id space 0, with types that are not replicated (see
/// scene::ImportedScene, of which there is one): hand it to field::Aspect::adopt, which checks it.
/// Payloads are checked against their hashes here. Takes as long as the import; any thread.
///
/// Errors are one line that names the file. Errc::file: the importer refused it, or crashed on it;
/// Errc::limit: it took too much memory or time; Errc::process: the importer could not be run;
/// Errc::protocol: what it sent is damaged.
Result<field::ChangeList> importScene(const std::filesystem::path& file,
                                      const ImportOptions& options = {});

}  // namespace gnomon::importer
