#include "app/sub_run.h"

#include "app/process.h"
#include "base/errors.h"
#include "io/file.h"

namespace windhover::app {

std::vector<std::string> sub_command(const std::string& verb, const std::filesystem::path& case_file,
                                     const std::vector<std::string>& overrides, int ranks) {
  std::vector<std::string> command;
  if (ranks > 1) command = {"mpiexec", "--oversubscribe", "-n", std::to_string(ranks)};
  command.insert(command.end(), {own_path(), verb, case_file});
  for (const auto& text : overrides) command.insert(command.end(), {"--set", text});
  return command;
}

std::string last_lines(const std::filesystem::path& log, int count) {
  const std::string text = io::read_text(log);
  size_t begin = text.size();
  for (int line = 0; line <= count && begin != std::string::npos && begin > 0; ++line)
    begin = text.rfind('\n', begin - 1);
  return text.substr(begin == std::string::npos ? 0 : begin);
}

void validate_run_name(const std::string& name, const std::string& place) {
  if (name.empty() || name.find('/') != std::string::npos || name.front() == '.')
    throw UserError("{}: run.name = \"{}\": is the name of a results folder", place, name);
}

}  // namespace windhover::app
