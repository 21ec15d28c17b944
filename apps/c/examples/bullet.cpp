// A ball goes through a pane, and a glass falls on stone: `bullet pane.frangible glass.frangible`.
#include "scenes.hpp"
#include <cstdio>

static const btScalar STEP = btScalar(1.0 / 240);

static void print(const char *what, const btVector3 &v) { std::printf("  %-28s %9.6f %9.6f %9.6f N s\n", what, v.x(), v.y(), v.z()); }

/// Takes steps until something breaks, then for a quarter of a second, and tells of the momentum. Returns false if it is not kept.
static bool play(Game &game, bool floor) {
    btVector3 before = game.momentum();
    for (int k = 0; k < 2400 && !game.report.broke; k++) {
        before = game.momentum();
        game.world.stepSimulation(STEP, 0);
    }
    if (!game.report.broke) return std::printf("  it held\n"), false;
    const btVector3 after = game.momentum();
    std::printf("  %zu pieces, %.4f J spent on cracks\n", game.report.fragments, game.report.fracture_energy);
    print("momentum before the step", before);
    if (floor) print("impulse of the floor", game.impulse);
    print("momentum after the step", after);
    for (int k = 0; k < 60; k++) game.world.stepSimulation(STEP, 0);
    print("a quarter of a second later", game.momentum());
    // Pieces meet gravity from the next step on. The rest is the rounding of Bullet's single precision.
    return (after - before - game.impulse * btScalar(floor)).length() < btScalar(1e-5) * before.length();
}

/// Both scenes. Returns true if they keep the momentum.
static bool run(const char *pane_file, const char *glass_file) {
    const frangible::Breakable pane = ask<frangible_breakable>(frangible_breakable_load, pane_file);
    const frangible::Breakable glass = ask<frangible_breakable>(frangible_breakable_load, glass_file);
    bool kept = true;
    {
        std::printf("a ball of 12 m/s goes through a pane\n");
        Game game(0);
        Thing *ball = ball_at(game, pane, 1, 12);
        kept &= play(game, false);
        std::printf("  the ball flies on at %.2f m/s\n", -ball->rigid->getLinearVelocity().z());
    }
    {
        std::printf("a glass falls 1.2 m on stone\n");
        Game game(9.81);
        glass_falls(game, glass, 1, 1.2);
        kept &= play(game, true);
    }
    return kept;
}

int main(int count, char **words) try {
    if (count < 3) return std::printf("bullet pane.frangible glass.frangible\n"), 2;
    return run(words[1], words[2]) && frangible_live_handles() == 0 ? 0 : 1;
} catch (const std::exception &error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
}
