// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/settings_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "config/load_settings.hpp"
#include "config/settings_table.hpp"

namespace stairway::config {
namespace {

constexpr const char* kIntroduction = R"(# Settings

<!-- Written by `stairway config reference`; a test holds this page to the program. -->

Settings are TOML. Weakest first, they come from: the defaults below; the profile ({}); the file
`/etc/stairwayd/stairwayd.toml`, or the one that `--config` names; `*.toml` in the folder `conf.d` beside it, by name;
`--set KEY=VALUE` on the command line. An unknown key or a value out of range is refused with file, line and column, and
with the key that was probably meant; `stairwayd` then exits with 78 and is not started again by systemd.

| to | use |
| --- | --- |
| see what is in effect and where each value comes from | `stairway config show` |
| see what differs from the defaults | `stairway config diff` |
| check a file before the daemon reads it | `stairway config check --config FILE`, `stairwayd --check-config` |
| let a running daemon read the files again | `systemctl reload stairwayd`, or SIGHUP |

`[detector]` and `[log]` change at a reload, the detector from the next sweep on; for every other key that differs the
log says that it takes a restart. When the new settings are refused, the old ones stay. `stairway config`,
`doctor`, `monitor`, `record` and `replay` read the same files as the daemon; the verbs that work on files of clouds and
scenes read what `--config` names and nothing else.

`config/stairwayd.toml` holds the same keys as a file to edit; `profile` chooses the set of defaults.
)";

std::string in_table(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string settings_reference() {
  Settings defaults;
  std::string out = fmt::format(kIntroduction, fmt::join(profile_names(), ", "));
  std::string section = "none yet";
  for (const Entry& entry : settings_table(defaults)) {
    const std::size_t dot = entry.key.rfind('.');
    const std::string of = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (of != section) {
      out += fmt::format("\n## {}\n\n| key | default | values | what it is |\n| --- | --- | --- | --- |\n",
                         of.empty() ? "Above the first section" : fmt::format("[{}]", of));
    }
    section = of;
    out += fmt::format("| `{}` | `{}` | {} | {} |\n", dot == std::string::npos ? entry.key : entry.key.substr(dot + 1),
                       show_value(entry), in_table(describe_range(entry)), in_table(entry.doc));
  }
  return out;
}

}  // namespace stairway::config
