#pragma once

#include <string>
#include <string_view>

#include "common/base/status.h"

namespace fitroom {

// How text is encoded, told by its byte order mark or, for UTF-16 without one, by a first character in ASCII.
enum class TextEncoding { kBytes, kUtf8WithMark, kUtf16LittleEndian, kUtf16BigEndian };

TextEncoding DetectTextEncoding(std::string_view bytes);

// Converts UTF-16 (with or without mark) to UTF-8, at most 1.5 times the size. Surrogates without partner become
// U+FFFD. INVALID_ARGUMENT for an odd number of bytes: the file is cut short.
Result<std::string> Utf16ToUtf8(std::string_view bytes, TextEncoding encoding);

}  // namespace fitroom
