/* A steel ball hits a baked body: `minimal pane.frangible` prints the pieces and how they fly. */
#include <frangible.h>
#include <stdio.h>

/* Prints what is wrong and how to mend it. */
static int failed(const char *what) {
    fprintf(stderr, "%s: %s\n", what, frangible_error_text());
    return 1;
}

int main(int count, char **words) {
    frangible_breakable kind;
    if (frangible_breakable_load(count > 1 ? words[1] : "pane.frangible", &kind)) return failed("load");
    frangible_body body;
    if (frangible_body_new(kind, 1, &body)) return failed("body");

    /* 130 g that fly along -z at 12 m/s, and meet the front of the pane in its middle. */
    frangible_striker ball = {.size = sizeof ball};
    if (frangible_striker_of("steel", &ball)) return failed("striker");
    ball.kind = FRANGIBLE_STRIKER_BALL;
    ball.mass = 0.13;
    ball.radius = 0.0158;
    ball.centre[2] = 0.0188;
    ball.motion.linear[2] = -12.0;
    frangible_contact contact = {.size = sizeof contact, .point = {0, 0, 0.003}, .normal = {0, 0, -1}, .speed = 12.0};

    frangible_outcome outcome;
    if (frangible_body_impact(body, &contact, 1, &ball, 1, NULL, &outcome)) return failed("impact");
    frangible_report report = {.size = sizeof report};
    if (frangible_outcome_report(outcome, &report)) return failed("report");
    printf("%zu fragments, %.3g J spent on cracks\n", report.fragments, report.fracture_energy);

    enum { MOST = 1000 };
    static frangible_motion motions[MOST]; /* at rest while the pane holds */
    const frangible_pose pose = {.rotation = {0, 0, 0, 1}};
    const frangible_motion still = {{0, 0, 0}, {0, 0, 0}};
    frangible_motion after;
    if (report.broke && report.fragments <= MOST) {
        if (frangible_outcome_motions(outcome, &pose, &still, &ball, NULL, motions, report.fragments, &after)) return failed("motions");
        printf("the ball goes on at %.2f m/s\n", -after.linear[2]);
    }
    for (size_t k = 0; k < report.fragments; k++) {
        frangible_solid solid = {.size = sizeof solid};
        frangible_geometry mesh = {.size = sizeof mesh};
        frangible_hulls hulls = {.size = sizeof hulls};
        if (frangible_outcome_solid(outcome, k, &solid) || frangible_outcome_geometry(outcome, k, &mesh) ||
            frangible_outcome_hulls(outcome, k, &hulls)) return failed("fragment");
        printf("%2zu: %6.2f g, %zu triangles, %zu convex parts, %6.2f m/s\n", k, 1e3 * solid.mass, mesh.indices_count / 3, hulls.count,
               -motions[k].linear[2]);
    }
    frangible_outcome_free(outcome);
    frangible_body_free(body);
    frangible_breakable_free(kind);
    return 0;
}
