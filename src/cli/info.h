// What `spectrad info` says, one function for each kind of thing it is asked about.
#pragma once

#include "cli/console.h"
#include "cli/options.h"
#include "spectrum/spectrum.h"

#include <string>

namespace spectrad {

class Library;

void printSceneInfo(const SceneArguments& arguments, bool json, Console& console);
/// What each feature of the scene costs and changes.
void printSceneCost(const SceneArguments& arguments, bool json, Console& console);
/// The fluorescent material's Donaldson matrix into an EXR or CSV file.
void writeReradiation(const SceneArguments& arguments, const std::string& material, const std::string& target,
                      bool json, Console& console);
void printCubeInfo(const std::string& file, bool json, Console& console);
void printSpectrumInfo(const std::string& text, const Library& library, bool json, Console& console);
/// A film of the library, or in a file x.film.
void printFilmInfo(const std::string& name, const Library& library, bool json, Console& console);
/// The library's entries, films among them, whose names start with `prefix`.
void printLibrary(const Library& library, const std::string& prefix, bool json);

/// The curve as columns of block characters between two wavelengths, with its axes.
[[nodiscard]] std::string plot(const Curve& curve, double from, double to);

}  // namespace spectrad
