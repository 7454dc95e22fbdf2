#pragma once
// A last line that holds kind, length and hash of all bytes before it, so that a file that was cut or changed
// is known.
#include <string>
#include <string_view>

namespace packbed {

/// The bytes with the sealing line behind them; `kind` is one short word, e.g. "bed".
std::string sealed(std::string_view bytes, std::string_view kind);
/// The bytes before the seal of the file at `path`. Throws InputError when the file is missing, has no seal
/// of this kind, or is not what was sealed.
std::string unsealed_file(const std::string& path, std::string_view kind);

/// True when the file ends with the seal of that kind; its bytes are not looked at.
bool is_sealed_as(const std::string& path, std::string_view kind);

}  // namespace packbed
