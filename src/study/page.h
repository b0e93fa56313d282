// The study as one page of HTML that needs nothing else: plots, maps, table.
#pragma once

#include "study/study.h"

#include <map>

namespace spectrad {

struct PageHead {
    std::string scene, device, size, command;
};
/// `maps`: PNG files (their bytes) of ΔE00 by doneName.
[[nodiscard]] std::string pageOf(const PageHead& head, const StudyReport& report,
                                 const std::map<std::string, std::string>& maps);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace spectrad
