//! `challenge lint`: everything that is wrong with an answer.

use std::fs;

use crate::challenge::Bench;
use crate::support::hexbench;

/// Exit code and page, in one line, of a look at an answer to the first case.
fn linted(bench: &Bench, files: &[(&str, &str)], case: bool) -> (Option<i32>, String) {
    let out = bench.path("out");
    let _ = fs::remove_dir_all(&out);
    fs::create_dir(&out).unwrap();
    for (name, text) in files {
        fs::write(out.join(name), text).unwrap();
    }
    let mut command = hexbench();
    command.args(["challenge", "lint"]).arg(&out);
    if case {
        command.arg("--case").arg(bench.path("challenge/cases/case-001"));
    }
    let output = command.output().unwrap();
    let page = String::from_utf8(output.stdout).unwrap();
    (output.status.code(), page.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[test]
fn a_look_at_an_answer_says_everything_that_is_wrong_with_its_place_and_what_to_write() {
    let bench = Bench::new();
    let header = "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
    let asked = fs::read_to_string(bench.path("challenge/cases/case-001/predict.csv")).unwrap();
    let rows = asked.lines().count() - 1;
    let lines: Vec<String> = (1..=rows).map(|row| format!("{row},1,2,3,4,5,6\n")).collect();
    let good = format!("{header}\n{}", lines.concat());
    let bad = good.replacen("1,1,2,3", "1,nan,x,3", 1).replacen("3,1,2", "2,1e99,2", 1);
    let parameters = "{\"format\": \"parameters/1\", \"parameters\": [\n  {\"name\": \"leg-1.stiffness\", \"value\": 4, \
        \"std\": -1, \"unit\": \"N/m\"},\n  {\"name\": \"leg_2.stiffness\", \"value\": 4, \"unit\": \"N/um\"}]}";
    let diagnosis = "{\"format\": \"diagnosis/1\", \"verdict\": \"named\", \"added\": [\"creap\"], \"candidates\": [\n  \
        {\"term\": \"creep\", \"probability\": 97},\n  {\"term\": \"creep\", \"probability\": 0.03}]}";
    let files = [
        ("predictions.csv", &*bad),
        ("parameters.json", parameters),
        ("diagnosis.json", diagnosis),
        ("prediction.csv", ""),
    ];
    let (code, page) = linted(&bench, &files, true);
    assert_eq!(code, Some(1), "{page}");
    for wanted in [
        "predictions.csv: line 2, column 2 (da_um): \"nan\": NaN and infinity are not predictions. next: Predict something",
        "predictions.csv: line 2, column 3 (db_um): \"x\": this is not a number. next: Write a number with a decimal point",
        "predictions.csv: line 4, column 2 (da_um): \"1e99\": the number is too large",
        "parameters.json: line 2, column 4: parameters[0].std (leg-1.stiffness): -1",
        "parameters.json: line 2, column 4: parameters[0].unit (leg-1.stiffness): \"N/m\"",
        "diagnosis.json: line 2, column 4: candidates[0] (creep): 97: a probability is between 0 and 1. next: Write a share",
        "diagnosis.json: line 3, column 4: candidates[1] (creep): this candidate is given twice",
        "sum to 97.03, not to 1",
        "the folder: prediction.csv: this file is not a part of an answer, and is not read. next: Write \"predictions.csv\"",
    ] {
        assert!(page.contains(wanted), "{wanted} is not in {page}");
    }
    let sound = [
        ("predictions.csv", &*good),
        ("parameters.json", &*parameters.replace("-1", "1").replace("N/m\"", "N/um\"")),
        (
            "diagnosis.json",
            &*diagnosis.replace("97}", "0.97}").replace(
                "\"term\": \"creep\", \"probability\": 0.03",
                "\"term\": \"none\", \"probability\": 0.03",
            ),
        ),
    ];
    for case in [true, false] {
        let (code, page) = linted(&bench, &sound, case);
        assert_eq!(code, Some(0), "{page}");
        for wanted in [
            "The answer can be read and scored",
            "predictions.csv: no standard uncertainties",
            "parameters.json: leg_2.stiffness: this name is not scored. next: Write \"leg-2.stiffness\"",
            "\"creap\" is no effect of the catalogue: it is never right. next: Write \"creep\"",
        ] {
            assert!(page.contains(wanted), "{wanted} is not in {page}");
        }
    }
    let (code, page) = linted(&bench, &[("predictions.csv", &*format!("{header}\n1,1,2,3,4,5,6\n"))], true);
    assert!(
        code == Some(1)
            && page.contains(&format!("{} of {rows} rows are missing, the first is row 2", rows - 1)),
        "{page}"
    );
    let (code, page) = linted(&bench, &[("predictions.csv", "row,da_mm,db_um\n")], true);
    for wanted in [
        "line 1, column 2: unknown column \"da_mm\"",
        "next: Write \"da_um\"",
        "the column dgamma_urad is missing",
    ] {
        assert!(code == Some(1) && page.contains(wanted), "{wanted} is not in {page}");
    }
    let nowhere = hexbench().args(["challenge", "lint"]).arg(bench.path("nowhere")).output().unwrap();
    assert_eq!(nowhere.status.code(), Some(5));
}
