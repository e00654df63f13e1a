#include "io/results.h"

#include "base/collective.h"
#include "io/file.h"

namespace windhover::io {

void prepare_results(const std::filesystem::path& directory, bool restart, MPI_Comm comm) {
  on_root(comm, [&] {
    if (!restart && std::filesystem::exists(directory / "history.csv"))
      throw UserError("{}: holds the results of another run; give another folder with --out, or --restart to continue",
                      directory.string());
    make_folder(directory);
  });
}

void write_text(const std::filesystem::path& file, const std::string& text, MPI_Comm comm) {
  on_root(comm, [&] { write_atomically(file, text); });
}

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json, MPI_Comm comm) {
  write_text(file, json.dump(2) + "\n", comm);
}

}  // namespace windhover::io
