# SPDX-License-Identifier: Apache-2.0
# A viewer who walks through the demo's room and turns: 4 s at 30 Hz. awk -f sim/demo/walk.awk > sim/demo/walk.csv
function smooth(t) { return t * t * t * (10 - 15 * t + 6 * t * t) }

function turn(axis, degrees,   h, s, w, x, y, z) {
    h = degrees * pi / 360
    s = sin(h)
    w = cos(h)
    x = axis == "x" ? s : 0
    y = axis == "y" ? s : 0
    z = axis == "z" ? s : 0
    product(w, x, y, z)
}

# The turn so far, q, times a further one: about the camera's own axes.
function product(w, x, y, z,   a, b, c, d) {
    a = qw * w - qx * x - qy * y - qz * z
    b = qw * x + qx * w + qy * z - qz * y
    c = qw * y - qx * z + qy * w + qz * x
    d = qw * z + qx * y - qy * x + qz * w
    qw = a; qx = b; qy = c; qz = d
}

BEGIN {
    pi = atan2(0, -1)
    print "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz"
    for (n = 0; n < 120; n++) {
        t = n / 30
        s = smooth(n / 119)
        step = 2 * pi * 1.8 * t                      # 1.8 steps a second
        x = -800 + 1600 * s
        y = -1700 + 18 * sin(step)                   # the head bobs
        z = -1500 + 900 * sin(pi * s)
        yaw = -36 + 74 * smooth(n / 119) + 3 * sin(2 * pi * 0.5 * t)
        pitch = -13 - 4 * sin(pi * s)                # a look at the floor on the way
        roll = 2.5 * sin(step / 2)
        qw = 1; qx = qy = qz = 0
        turn("y", yaw); turn("x", pitch); turn("z", roll)
        printf "%.6f,%.3f,%.3f,%.3f,%.9f,%.9f,%.9f,%.9f\n", t, x, y, z, qw, qx, qy, qz
    }
}
