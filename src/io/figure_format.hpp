#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace strutt {

/// The formats a figure can have.
enum class FigureFormat { png, svg, pdf };

/// The format that the ending of a path tells; in any case; throws InvalidInput for another ending.
FigureFormat figure_format(const std::filesystem::path& path);

/// gnuplot's terminal and its options: 1600 x 1100 pixels, or the same shape.
std::string gnuplot_terminal(FigureFormat format);

/// The file gnuplot draws into, in its directory, and the most bytes of it that are taken.
inline constexpr const char* kPictureFile = "picture";
inline constexpr double kPictureWidth = 1600.0, kPictureHeight = 1100.0;  ///< pixels
inline constexpr std::size_t kLargestPicture = std::size_t{1} << 30;

}  // namespace strutt
