#include "app/commands.h"

int main(int argc, char** argv) { return windhover::app::run_command(argc, argv); }
