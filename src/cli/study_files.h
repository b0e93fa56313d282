// The folder of a study: results.json, which a later run goes on from, results.csv and index.html.
#pragma once

#include "cli/console.h"
#include "study/study.h"

#include <filesystem>
#include <set>
#include <string>

namespace spectrad {

/// What must be the same for rows of an earlier run to count.
struct StudyIdentity {
    std::string sceneSha256, command, device;
};

class StudyFiles {
  public:
    /// Makes the folder if it is not there, and reads what an earlier run of the same study left. Throws
    /// MachineError if the folder cannot be made or written.
    StudyFiles(std::filesystem::path folder, StudyIdentity identity);

    /// Names (doneName) of the rows that are there already.
    [[nodiscard]] std::set<std::string> done() const;
    /// Keeps a row, on disk too.
    void add(const StudyRow& row);
    /// Takes the spectra and what was left out, writes table and page; returns the whole study, earlier rows
    /// first.
    const StudyReport& finish(StudyReport report, const std::string& sceneFile);

  private:
    void save() const;

    std::filesystem::path folder_;
    StudyIdentity identity_;
    StudyReport whole_;
};

/// File of a row's map of ΔE00, in the folder.
[[nodiscard]] std::string mapName(const StudyRow& row);
[[nodiscard]] Json described(const StudyReport& report);

}  // namespace spectrad
