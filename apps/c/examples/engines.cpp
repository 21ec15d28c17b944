// The section of docs/engines.md about Bullet: `engines pane.frangible`. A ball hits a free pane with a hundred seeds, without an engine, and in
// Bullet at 60, 120 and 240 steps per second.
#include "scenes.hpp"
#include <cmath>
#include <cstdio>

static const int SEEDS = 100, RATES[] = {60, 120, 240};

struct Run { bool broke; double pieces, first, cracks, impulse, lost; };
struct Worst { double momentum = 0, energy = -1e9; };

/// What came of a throw. Only what the striker has lost is known of a body that held.
static Run run_of(const frangible_report &r, double impulse, double lost) {
    const double none = std::nan("");
    if (!r.broke) return {false, none, none, none, none, lost};
    return {true, double(r.fragments), r.first_crack_time, r.fracture_energy, impulse, lost};
}

/// The blow alone: the striker's motion just after it.
static Run alone(frangible_breakable pane, uint64_t seed, double speed) {
    Game game(0);
    Thing *ball = ball_at(game, pane, seed, speed);
    Thing *body = game.things[0].get();
    frangible_striker by = Game::striker(*ball, *body);
    frangible_contact contact = frangible::sized<frangible_contact>();
    // The pane is 4 mm thick.
    const double point[] = {0.01, 0.005, 0.002}, normal[] = {0, 0, -1};
    put(point, contact.point);
    put(normal, contact.normal);
    put(point, by.centre);
    by.centre[2] += by.radius;
    contact.speed = speed;
    const frangible_pose *in_its_frame = nullptr;
    const frangible::Outcome outcome =
        ask<frangible_outcome>(frangible_body_impact, body->body, &contact, size_t(1), &by, size_t(1), in_its_frame);
    const auto report = ask<frangible_report>(frangible_outcome_report, outcome);
    frangible_pose pose = frangible_pose();
    pose.rotation[3] = 1;
    const frangible_motion still = frangible_motion();
    // A row for each piece, or for the body that held.
    const size_t count = report.broke ? report.fragments : 1;
    std::vector<frangible_motion> motions(count);
    frangible_pose *no_poses = nullptr;
    const auto after = ask<frangible_motion>(frangible_outcome_motions, outcome, &pose, &still, &by, no_poses, motions.data(), count);
    return run_of(report, -report.impulse[2], speed + after.linear[2]);
}
/// Kinetic energy of all that moves, J.
static double energy_of(const Game &game) {
    double sum = 0;
    for (auto &t : game.things) if (t->rigid->getInvMass() > 0) {
        const btVector3 spin = t->rigid->getAngularVelocity();
        sum += 0.5 * t->rigid->getLinearVelocity().length2() / t->rigid->getInvMass();
        sum += 0.5 * spin.dot(t->rigid->getInvInertiaTensorWorld().inverse() * spin);
    }
    return sum;
}
static Run in_bullet(frangible_breakable pane, uint64_t seed, double speed, int rate, Worst &worst) {
    Game game(0);
    Thing *ball = ball_at(game, pane, seed, speed);
    for (int k = 0; k < rate / 4; k++) {
        const bool whole = !game.report.broke;
        const btVector3 momentum = game.momentum();
        const double energy = energy_of(game);
        game.world.stepSimulation(btScalar(1.0 / rate), 0);
        if (whole && game.report.broke) {
            worst.momentum = std::fmax(worst.momentum, (game.momentum() - momentum).length() / momentum.length());
            worst.energy = std::fmax(worst.energy, (energy_of(game) + game.report.fracture_energy - energy) / energy);
        }
    }
    const auto &r = game.report;
    const double lost = speed + ball->rigid->getLinearVelocity().z();
    return run_of(r, game.impulse.length(), lost);
}

/// Prints a mean and its standard error, of the seeds for which the number is known.
static void cell(const std::vector<Run> &runs, const std::vector<Run> &less, double (*of)(const Run &), const char *shape) {
    double sum = 0, squares = 0, count = 0;
    for (size_t k = 0; k < runs.size(); k++) {
        const double x = of(runs[k]) - (&runs == &less ? 0 : of(less[k]));
        if (!std::isnan(x)) sum += x, squares += x * x, count++;
    }
    std::printf(shape, sum / count, std::sqrt(std::fmax(squares - sum * sum / count, 0) / count / (count - 1)));
}
static void row(const char *name, const std::vector<Run> *columns, double (*of)(const Run &), const char *shape) {
    std::printf("| %s |", name);
    for (int c = 0; c < 4; c++) cell(columns[c], columns[c], of, shape);
    std::printf("\n");
}

int main(int count, char **words) try {
    if (count < 2) return std::printf("engines pane.frangible\n"), 2;
    const frangible::Breakable pane = ask<frangible_breakable>(frangible_breakable_load, words[1]);
    Worst worst;
    std::printf("A ball hits the free pane in Bullet %d.%02d, with the library for C and the example\n"
                "[apps/c/examples/bullet.hpp](../apps/c/examples/bullet.hpp), which asks before Bullet solves the contacts: means of a hundred seeds with\n"
                "their standard errors. *The blow alone* is the same blow, and the ball's way through the pieces, without an engine. The motions in Bullet are\n"
                "those a quarter of a second later: for so long Bullet leaves out contacts between the ball and the pieces. Made by\n"
                "`cargo xtask c --engines`.\n\n",
                BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100);
    std::printf("![A steel ball of 12 m/s goes through a pane in Bullet](engines/bullet-pane.jpg)\n\n"
                "![A glass falls 1.2 m on stone in Bullet](engines/bullet-glass.jpg)\n\n");
    for (const double speed : {4.0, 6.0, 12.0, 20.0, 30.0}) {
        std::vector<Run> runs[4];
        for (int seed = 0; seed < SEEDS; seed++) {
            runs[0].push_back(alone(pane, uint64_t(seed), speed));
            for (int r = 0; r < 3; r++) runs[r + 1].push_back(in_bullet(pane, uint64_t(seed), speed, RATES[r], worst));
        }
        std::printf("### ball on pane in Bullet, %g m/s\n\n| | the blow alone | 60 steps per second | 120 | 240 |\n", speed);
        std::printf("|---|---|---|---|---|\n| broke, of %d |", SEEDS);
        for (const auto &column : runs) {
            int broke = 0;
            for (const Run &run : column) broke += run.broke;
            std::printf(" %d |", broke);
        }
        std::printf("\n");
        row("pieces", runs, [](const Run &r) { return r.pieces; }, " %.1f ± %.1f |");
        row("first crack, µs", runs, [](const Run &r) { return 1e6 * r.first; }, " %.1f ± %.1f |");
        row("energy of the cracks, J", runs, [](const Run &r) { return r.cracks; }, " %.4f ± %.4f |");
        row("impulse of the blow, N·s", runs, [](const Run &r) { return r.impulse; }, " %.3f ± %.3f |");
        row("what the striker has lost, m/s", runs, [](const Run &r) { return r.lost; }, " %.2f ± %.2f |");
        std::printf("| difference of the same seeds, m/s | |");
        for (int c = 1; c < 4; c++) cell(runs[c], runs[0], [](const Run &r) { return r.lost; }, " %+.2f ± %.2f |");
        std::printf("\n\n");
    }
    std::printf("Over the step of a break, the momentum of ball and pane changes by %.1e of it at most. Their kinetic energy and that of the\n"
                "cracks together change by %+.1e of it at most (negative: always a loss).\n", worst.momentum, worst.energy);
    return 0;
} catch (const std::exception &error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
}
