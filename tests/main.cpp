// One Catch2 main for every test program: PETSc (and with it MPI) lives as long as the session.
#define CATCH_CONFIG_RUNNER
#include <petscsys.h>

#include <catch2/catch.hpp>

int main(int argc, char** argv) {
  PetscInitialize(nullptr, nullptr, nullptr, nullptr);
  const int failed = Catch::Session().run(argc, argv);
  int worst = 0;
  MPI_Allreduce(&failed, &worst, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  PetscFinalize();
  return worst == 0 ? 0 : 1;
}
