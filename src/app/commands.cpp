#include "app/commands.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "app/mesh_file.h"
#include "app/session.h"
#include "app/simulation.h"
#include "app/study.h"
#include "app/trim.h"
#include "app/verify.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "base/version.h"

namespace windhover::app {
namespace {

struct Arguments {
  std::string path;
  std::vector<std::string> overrides;
  std::string petsc;
  RunOptions run;
  bool check = false;
  bool quick = false;
};

int mesh_command(const Arguments& a) {
  reject_mpiexec("mesh");
  const Case c = load_case(a.path, a.overrides);
  if (can_make_mesh(c)) make_mesh(c);
  const Session session("");
  return guarded([&] {
    report_mesh(c);
    return 0;
  });
}

int run_command(const Arguments& a) {
  const Case c = load_case(a.path, a.overrides);
  require_mesh(c);
  const Session session(a.petsc);
  catch_interrupts();
  return guarded([&] { return run_simulation(c, a.run); });
}

int check_command(const Arguments& a) {
  const Case c = load_case(a.path, a.overrides);
  require_mesh(c);
  const Session session(a.petsc);
  return guarded([&] { return check_simulation(c); });
}

int trim_command(const Arguments& a) {
  const Case c = load_case(a.path, a.overrides);
  validate_trim(c);
  require_mesh(c);
  const Session session(a.petsc);
  catch_interrupts();
  return guarded([&] { return run_trim(c, a.run.out); });
}

int verify_command(const Arguments& a) {
  reject_mpiexec("verify");
  return verify(a.path, a.quick);
}

int study_command(const Arguments& a) {
  reject_mpiexec("study");
  return study(a.path, {a.run.out, a.overrides, a.check});
}

int keys_command() {
  fmt::print("{}{}{}", case_file_documentation(), verify_documentation(), study_documentation());
  return 0;
}

void add_overrides(CLI::App& command, Arguments& a) {
  command.add_option("--set", a.overrides, "override a key: key=value; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
}

void add_case(CLI::App& command, Arguments& a) {
  command.add_option("CASE", a.path, "case file")->required();
  add_overrides(command, a);
}

void add_petsc(CLI::App& command, Arguments& a) {
  command.add_option("--petsc", a.petsc, "options passed through to PETSc, such as \"-log_view\"");
}

}  // namespace

int run_command(int argc, char** argv) {
  CLI::App app{"Windhover: compressible flow about moving bodies"};
  app.set_version_flag("--version", fmt::format("windhover {} ({})", version, revision));
  app.require_subcommand(1);
  Arguments a;

  auto* mesh_app = app.add_subcommand("mesh", "make the mesh of a case with gmsh, report its quality");
  add_case(*mesh_app, a);

  auto* run_app = app.add_subcommand("run", "run a case");
  add_case(*run_app, a);
  add_petsc(*run_app, a);
  run_app->add_option("--out", a.run.out, "folder of the results");
  run_app->add_flag("--restart", a.run.restart, "continue from the newest checkpoint in the results");
  run_app->add_option("--steps", a.run.steps, "number of time steps instead of the case's")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));

  auto* check_app = app.add_subcommand("check", "dry run: case, mesh, memory and time; no step is taken");
  add_case(*check_app, a);
  add_petsc(*check_app, a);

  auto* trim_app = app.add_subcommand("trim", "find where the mean forces on a vehicle vanish, to start a run from there");
  add_case(*trim_app, a);
  add_petsc(*trim_app, a);
  trim_app->add_option("--out", a.run.out, "folder of the results");

  auto* verify_app = app.add_subcommand("verify", "run a case's checks, compare each figure with the expected one");
  verify_app->add_option("CASEDIR", a.path, "folder with verify.toml")->required();
  verify_app->add_flag("--quick", a.quick, "only the runs marked quick");

  auto* study_app = app.add_subcommand("study", "make a table of runs: errors against cost, and the cheapest accurate setting");
  study_app->add_option("STUDY", a.path, "study file")->required();
  add_overrides(*study_app, a);
  study_app->add_option("--out", a.run.out, "folder of the results");
  study_app->add_flag("--check", a.check, "read everything, list the runs, make none");

  app.add_subcommand("keys", "print the reference of all keys")->group("");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return guarded([&]() -> int { throw UserError("{} (windhover --help tells more)", error.what()); });
  }
  if (*run_app || *trim_app) use_large_pages(argv);
  return guarded([&] {
    if (*mesh_app) return mesh_command(a);
    if (*run_app) return run_command(a);
    if (*check_app) return check_command(a);
    if (*trim_app) return trim_command(a);
    if (*verify_app) return verify_command(a);
    if (*study_app) return study_command(a);
    return keys_command();
  });
}

}  // namespace windhover::app
