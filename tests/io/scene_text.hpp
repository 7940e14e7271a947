#pragma once

#include <string>

#include "io/scratch.hpp"
#include "strutt/io/scene_file.hpp"

/// Scenes as text, and what is said about them.
namespace strutt::test {

inline const std::string kRod = "[pendulum]\nlength = 1.0\n";
inline const std::string kShaken = kRod + "[support]\nfrequency = 12.0\n";

inline Scene scene_of(const std::string& text) { return parse_scene(text, "s.toml").scene; }

/// The message of the FileError that reading `text` must throw.
inline std::string complaint(const std::string& text) {
  INFO(text.substr(0, 400));
  return message_of<FileError>([&] { parse_scene(text, "s.toml"); });
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace strutt::test
