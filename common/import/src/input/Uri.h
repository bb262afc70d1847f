#pragma once

#include <gnomon/base/Error.h>

#include <memory>
#include <string>
#include <string_view>

#include "input/Files.h"

namespace gnomon::importer {

/// %XX decoded; an error where % is not followed by two hexadecimal digits.
Result<std::string> percentDecoded(std::string_view text);

/// RFC 4648 base64, standard or URL alphabet, with or without padding, no white space.
Result<Bytes> base64Decoded(std::string_view text);

/// What a glTF URI names: a data: URI's bytes, or a file below the model's folder. Nothing else is
/// ever opened: no scheme but data:, no host.
Result<std::shared_ptr<const Bytes>> readUri(std::string_view uri, Folder& folder);

}  // namespace gnomon::importer
