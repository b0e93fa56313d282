// ICC profiles inside pictures, by Little CMS: what colours a picture's numbers are.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace spectrad {

class IccProfile {
  public:
    /// `channels` of the picture: 1 grey, 3 RGB. Throws InputError, a clause without a file's name, for a
    /// profile that is damaged, is no picture's, or is for other channels.
    IccProfile(const std::string& bytes, int channels);

    /// Signals 0 … 1 (of a grey picture the first) to XYZ as ICC.1:2022 connects colours: relative to the
    /// medium's white, which is D50 with Y = 1, chromatically adapted. May be called by several threads.
    [[nodiscard]] std::array<double, 3> xyz(const std::array<double, 3>& signals) const;
    /// X, Y, Z of that white.
    [[nodiscard]] static std::array<double, 3> white();

  private:
    std::shared_ptr<void> transform_;
};

}  // namespace spectrad
