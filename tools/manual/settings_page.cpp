// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "config/settings_table.hpp"
#include "tools/manual/pages.hpp"
#include "tools/manual/roff.hpp"

namespace stairway::tools {

Page settings_page(const std::string& more) {
  Page page{"stairwayd.toml", '5', {}};
  page.text = roff::title(page.name, page.section) + roff::heading("NAME") +
              roff::text("stairwayd.toml - settings of stairwayd and stairway") + "\n" + more + roff::heading("KEYS");
  config::Settings defaults;
  std::string section;
  for (const config::Entry& entry : config::settings_table(defaults)) {
    const std::size_t dot = entry.key.rfind('.');
    const std::string of = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (of != section) page.text += fmt::format(".SS [{}]\n", roff::text(of));
    section = of;
    page.text += roff::item(roff::bold(entry.key) + roff::text(" = " + config::show_value(entry)),
                            fmt::format("{} ({})", entry.doc, config::describe_range(entry)));
  }
  page.text += roff::heading("SEE ALSO") + roff::bold("stairwayd") + "(8),\n" + roff::bold("stairway-config") + "(1)\n";
  return page;
}

}  // namespace stairway::tools
