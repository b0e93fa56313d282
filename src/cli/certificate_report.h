// Certificates as users read them: text, JSON, attributes of a file; and what a file says of its scene.
#pragma once

#include "cli/console.h"
#include "image/cube.h"
#include "scene/scene.h"
#include "study/chooser.h"
#include "verify/tolerance.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

struct VerifyArguments {
    std::string share, seed = "1", observer = "cie1931-2";
};
/// "1%" or "1": 0.01. Throws UsageError that names the option.
[[nodiscard]] double parseShare(const std::string& option, const std::string& text);
/// A whole number of up to 64 bits. Throws UsageError.
[[nodiscard]] std::uint64_t parseSeed(const std::string& text);

[[nodiscard]] std::string inWords(const Certificate& certificate);
[[nodiscard]] Json described(const Certificate& certificate);
/// What a file carries of its certificate.
[[nodiscard]] std::map<std::string, std::string> attributesOf(const Certificate& certificate);

/// What was chosen for a tolerance, as it was asked for.
[[nodiscard]] std::string inWords(const Chosen& chosen, const std::string& asked);
[[nodiscard]] Json described(const Chosen& chosen, const Certificate& certificate, const std::string& asked);
[[nodiscard]] std::map<std::string, std::string> attributesOf(const Chosen& chosen, const std::string& asked);
/// Exit code 1, with a line that says why, where no settings met it or the certificate refutes it.
[[nodiscard]] ExitCode toleranceVerdict(const Chosen& chosen, const Certificate& certificate,
                                        const std::string& asked);

/// "a.xml 3fa9…, D65.csv 07b1…": every file that the scene read with its SHA-256, in that order.
[[nodiscard]] std::string sourcesOf(const Scene& scene);
/// Files that are not what an image's sources say they were, a line each.
[[nodiscard]] std::vector<std::string> changedSince(const std::string& sources, const Scene& scene);

}  // namespace spectrad
