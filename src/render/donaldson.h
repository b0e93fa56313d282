// Donaldson matrices, measured or made: how much comes out at one wavelength of what goes in at another.
#pragma once

#include "base/error.h"

#include <string>
#include <vector>

namespace spectrad {

/// A bispectral matrix as read: radiance factors D[row][column], row = emission, column = excitation band
/// (both nm, ascending).
struct DonaldsonMatrix {
    std::vector<double> emission, excitation;
    std::vector<std::vector<double>> value;
};

/// Text (CSV or columns): first column emission_nm, then a column exNNN for each excitation band. EXR: the
/// bispectral channels of the layout 1.0, T.<in>nm.<out>nm, and T.<w>nm for the diagonal, as the mean over
/// the image; pairs of wavelengths without a channel are 0, which is said where the emission is not below the
/// excitation. Throws InputError with the file, and the line of a text.
[[nodiscard]] DonaldsonMatrix readDonaldson(const std::string& file, Notes& notes);

}  // namespace spectrad
