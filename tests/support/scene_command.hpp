#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test {

/// A folder with a scene, and a command of the program on it.
class SceneCommand {
 public:
  SceneCommand(std::string name, const std::string& scene) : name_(std::move(name)) {
    write("scene.toml", scene);
  }

  std::string path(const std::string& name) const { return (directory_.path() / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  Result run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{name_, path("scene.toml")};
    words.insert(words.end(), more.begin(), more.end());
    return strutt(words);
  }

 private:
  std::string name_;
  ScratchDirectory directory_;
};

}  // namespace strutt::test
