//! Responses of sensors from files.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use fault::Fault;
use formats::read_response;
use impact::response::Response;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::fs;
use std::path::PathBuf;

fn file(name: &str, bytes: impl AsRef<[u8]>) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn read(bytes: impl AsRef<[u8]>) -> Response {
    let (_folder, path) = file("response.txt", bytes);
    read_response(&path).unwrap()
}

fn refused(text: &str) -> String {
    let (_folder, path) = file("sensor.csv", text);
    let error = read_response(&path).unwrap_err();
    assert!(error.culprit().file.is_some(), "{error}");
    let sentence = error.to_string();
    assert_eq!(sentence.matches("sensor.csv").count(), 1, "{sentence}");
    sentence.rsplit_once("sensor.csv").unwrap().1.to_owned()
}

const SAC: &str = "* INPUT UNIT : M\n\
    ZEROS 3\n\
    POLES 4\n -4.44 4.44\n-4.44\t-4.44\n* a comment between\n-1.0D+02 0\n-300 0.0\n\
    CONSTANT 3.0e+04\n";

#[test]
fn sac_roots_that_are_not_listed_are_at_the_origin() {
    let Response::PolesZeros(found) = read(SAC) else {
        panic!("poles and zeros");
    };
    assert_eq!(found.zeros(), [Complex64::default(); 3]);
    assert_eq!(found.poles()[2], Complex64::new(-100.0, 0.0));
    assert_eq!((found.poles().len(), found.gain()), (4, 3e4));
    let listed = SAC.replace("ZEROS 3", "zeros 3\r\n-1 0\r");
    let Response::PolesZeros(found) = read(listed) else {
        panic!("poles and zeros");
    };
    assert_eq!(
        found.zeros()[..2],
        [Complex64::new(-1.0, 0.0), Complex64::default()]
    );
}

#[test]
fn sac_files_that_are_wrong_are_refused_with_the_line() {
    let changed = |from: &str, to: &str| refused(&SAC.replace(from, to));
    assert!(changed("-300 0.0", "-300").starts_with(" line 8: POLES = \"\""));
    assert!(changed("-300 0.0", "-3OO 0").starts_with(" line 8: POLES = \"-3OO\""));
    assert!(changed("-300 0.0", "-300 0 1").contains("a further field, \"1\""));
    assert!(changed("POLES 4", "POLES 3").contains("more than 3 rows"));
    assert!(changed("POLES 4", "POLES many").starts_with(" line 3: POLES = \"many\""));
    assert!(changed("POLES 4", "ZEROS 4").contains("ZEROS occurs a second time"));
    assert!(changed("CONSTANT 3.0e+04\n", "").contains("CONSTANT is missing"));
    assert!(changed("CONSTANT 3.0e+04", "CONSTANT 3.0e+04\nPOLES 0").contains("second time"));
    assert!(changed("ZEROS 3\n", "1 2\nZEROS 3\n").starts_with(" line 2: \"1 2\" belongs to"));
    // one that is counted is at the origin
    assert!(changed("POLES 4", "POLES 5").contains("response.poles contains 0+0i"));
    assert!(changed("-4.44\t-4.44", "-4.44 4.44").contains("without its conjugate"));
    assert!(changed("ZEROS 3", "ZEROS 5").contains("use the sensor's velocity"));
    let (_folder, path) = file("sensor.csv", SAC.replace("-300 0.0", "300 0"));
    let error = read_response(&path).unwrap_err();
    let culprit = error.culprit();
    assert_eq!(
        (culprit.key.as_deref(), culprit.number),
        (Some("response.poles"), Some(300.0))
    );
}

#[test]
fn tables_have_units_in_their_headers() {
    let expected = Complex64::from_polar(10.0, -PI / 2.0);
    let texts = [
        "frequency_hz,amplitude,phase_deg\n1000,1,0\n2e3,10,-90\n",
        "# maker's certificate\nf [kHz];amplitude [V/(m/s)];phase [rad]\n1;1;0\n2,0;1e1;-1,5707963267948966\n",
        "\u{feff}Sensor 7\n\nphase_rad\tfrequency_mhz\tcoherence\tamplitude_dB\n0\t1e-3\t1\t0\n-1.5707963267948966\t0.002\t0.5\t20\n",
        "Freq/kHz  Gain/dB  Phase(\u{b0})\n1 0 0\n2 20 -90\n",
    ];
    for text in texts {
        let wide: Vec<u8> = "\u{feff}"
            .encode_utf16()
            .chain(text.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect();
        for response in [read(text), read(wide)] {
            assert!(
                (response.at(2e3) - expected).norm() < 1e-12,
                "{text}: {}",
                response.at(2e3)
            );
            assert_eq!(response.at(2.1e3), Complex64::default());
            assert!(!response.is_minimum_phase());
        }
    }
    let response = read("frequency_khz,amplitude_db\n0,0\n10,0\n20,-6\n40,-18\n");
    assert!(response.is_minimum_phase() && response.at(2e4).arg() < -0.3);
}

#[test]
fn tables_that_are_wrong_are_refused_with_the_line() {
    assert!(refused("").contains("no header with frequency and amplitude"));
    assert!(refused("1,2\n3,4\n").contains("begins with \"frequency_hz,amplitude,phase_deg\""));
    assert!(
        refused("frequency,amplitude\n1,1\n")
            .starts_with(" line 1: the column \"frequency\" needs a unit, one of Hz")
    );
    assert!(refused("f_hz,amplitude,phase\n1,1,0\n").contains("one of deg, rad"));
    assert!(refused("f_hz,frequency_khz,gain\n1,1,0\n").contains("keep one of them"));
    let rows = |rows: &str| refused(&format!("\nf_hz,amplitude\n{rows}"));
    assert!(rows("1,1\n1,2\n").starts_with(": response.frequency_hz = 1 does not follow 1"));
    assert!(rows("-1,1\n2,1\n").contains("response.frequency_hz = -1 is outside [0, inf)"));
    assert!(rows("1,-1\n2,1\n").contains("response.amplitude = -1 is outside [0, inf)"));
    assert!(rows("1,1\n2,NaN\n").starts_with(" line 4: amplitude = \"NaN\" is not a finite"));
    assert!(rows("1,1\n2\n").starts_with(" line 4: amplitude = \"\" is not"));
    assert!(rows("1,1\n2,0\n").contains("response.amplitude = 0 at 2 Hz"));
    assert!(rows("1,1\n").contains("response.frequency_hz has 1 elements"));
    let many: String = (0..10_001).map(|i| format!("{i},1\n")).collect();
    assert!(rows(&many).contains("10001 elements, but 2 to 10000"));
}
