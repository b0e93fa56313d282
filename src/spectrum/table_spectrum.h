// From a table that a reader made to the spectrum that a role asks of it.
#pragma once

#include "spectrum/readers/reader.h"
#include "spectrum/resolver.h"

namespace spectrad {

/// `column`: a number (1 = wavelength), a header, or "" for the first value column — all of them where the
/// role takes several. Throws InputError for a column that is not there (with those that are).
[[nodiscard]] Spectrum tableSpectrum(SpectrumTable table, const std::string& file, const std::string& column,
                                     Role role, const SourceLocation& where);
/// "400:0.1 500:0.25".
[[nodiscard]] Spectrum pairsSpectrum(std::string_view text, const SourceLocation& where);
/// The same spectrum, of its channels only one.
[[nodiscard]] Spectrum oneChannel(Spectrum spectrum, size_t channel);

}  // namespace spectrad
