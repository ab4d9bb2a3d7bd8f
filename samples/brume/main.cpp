#include "commands/all.hpp"

int main(int argc, char **argv)
{
    return brume::tool::run_command_line(argc, argv);
}
