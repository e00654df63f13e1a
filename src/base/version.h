// Which Windhover this is.
#pragma once

namespace windhover {

extern const char* const version;
extern const char* const revision;  ///< of the source tree in git, "unknown" outside it

}  // namespace windhover
