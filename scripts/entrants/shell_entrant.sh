#!/bin/sh
# An entrant in plain POSIX shell and awk: one constant 6x6 compliance for the whole workspace, by least squares on the change of
# the wrench, without any kinematics. Poses are predicted as commanded plus a constant and such a compliance.
# Called as: shell_entrant.sh CASE OUT
set -eu
LC_ALL=C
export LC_ALL
case_folder=$1
out=$2

awk -F, '
function place(name) {
    if (name in column) return column[name]
    print FILENAME ": no column " name > "/dev/stderr"
    exit 1
}

# Columns of a table by their names.
FNR == 1 {
    split("", column)
    for (k = 1; k <= NF; k++) { sub(/\r$/, "", $k); column[$k] = k }
    split("fx_N fy_N fz_N mx_Nm my_Nm mz_Nm", wrench, " ")
    absolute = 0
    for (k in column) if (k ~ /^measured_/) absolute = 1
    if (NR == 1) {
        poses = absolute
        if (poses) split("measured_a_mm measured_b_mm measured_c_mm measured_alpha_deg measured_beta_deg measured_gamma_deg", reading, " ")
        else split("da_um db_um dc_um dalpha_urad dbeta_urad dgamma_urad", reading, " ")
        split("a_mm b_mm c_mm alpha_deg beta_deg gamma_deg", pose, " ")
    }
    unknowns = poses ? 7 : 6
    next
}

# Regressors x of a row: change of the wrench, and 1 for poses.
{
    for (k = 1; k <= 6; k++) {
        x[k] = $(place(wrench[k]))
        if (("ref_" wrench[k]) in column) x[k] -= $(column["ref_" wrench[k]])
    }
    x[7] = 1
}

# Normal equations from the measurements.
NR == FNR {
    for (i = 1; i <= unknowns; i++) {
        for (j = 1; j <= unknowns; j++) normal[i, j] += x[i] * x[j]
        for (k = 1; k <= 6; k++) {
            y = $(place(reading[k])) - (poses ? $(place(pose[k])) : 0)
            right[i, k] += x[i] * y
        }
    }
    next
}

FNR == 2 { solve() }

{
    line = $(place("row"))
    for (k = 1; k <= 6; k++) {
        y = poses ? $(place(pose[k])) : 0
        for (i = 1; i <= unknowns; i++) y += right[i, k] * x[i]
        line = line sprintf(",%.12g", y)
    }
    if (!header++) {
        if (poses) print "row,predicted_a_mm,predicted_b_mm,predicted_c_mm,predicted_alpha_deg,predicted_beta_deg,predicted_gamma_deg"
        else print "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad"
    }
    print line
}

# Gauss-Jordan with pivots on the diagonal; what no load has moved is left at zero.
function solve(    i, j, k, p, factor) {
    for (p = 1; p <= unknowns; p++) scale[p] = normal[p, p]
    for (p = 1; p <= unknowns; p++) {
        if (scale[p] <= 0 || normal[p, p] <= 1e-9 * scale[p]) { idle[p] = 1; continue }
        factor = normal[p, p]
        for (j = 1; j <= unknowns; j++) normal[p, j] /= factor
        for (k = 1; k <= 6; k++) right[p, k] /= factor
        for (i = 1; i <= unknowns; i++) if (i != p) {
            factor = normal[i, p]
            for (j = 1; j <= unknowns; j++) normal[i, j] -= factor * normal[p, j]
            for (k = 1; k <= 6; k++) right[i, k] -= factor * right[p, k]
        }
    }
    for (p in idle) for (k = 1; k <= 6; k++) right[p, k] = 0
}
' "$case_folder/measurements.csv" "$case_folder/predict.csv" >"$out/predictions.csv"
