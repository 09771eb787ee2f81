//! Prompts in other languages, prompts that are refused, and texts that are no prompts at all.

use std::time::{Duration, Instant};

use super::summary::{all_are_read_as, known, summary};
use super::vocabulary::vocabulary;

#[rustfmt::skip]
#[test]
fn other_languages() {
    all_are_read_as(&[
        ("50 Bilder von einem halb vergrabenen Torpedo in Sand bei 15 Metern Tiefe", "50 images; 1 torpedo (buried 0.5); sand; 15 m deep"),
        ("Erzeuge 100 Bilder mit zwei Ankern und einem Fass auf Schlick, 12 m Wassertiefe", "100 images; 2 anchor; 1 barrel; mud; 12 m deep"),
        ("drei Reifen, eine Kiste und mehrere Flaschen auf steinigem Grund, 8 m tief, 60 Bilder", "60 images; 3 tire; 1 crate; 3..7 bottle; cobbles; 8 m deep"),
        ("1.000 Bilder von Minen ohne Steine, Tiefe zwischen 10 und 20 m", "1000 images; ? mine; no rock; 10..20 m deep"),
        ("20 Bilder: ein gesunkenes Boot auf der Seite liegend, klares Wasser", "20 images; 1 shipwreck (onside, resting); clear"),
        ("Genera 100 imágenes de tres neumáticos y un ancla sobre arena a 12 metros de profundidad", "100 images; 3 tire; 1 anchor; sand; 12 m deep"),
        ("50 imágenes con dos barriles medio enterrados en lodo, profundidad entre 5 y 10 m", "50 images; 2 barrel (buried 0.5); mud; 5..10 m deep"),
        ("una bicicleta y un carrito de compras en un puerto, agua muy turbia, 40 imágenes", "40 images; 1 bicycle; 1 shopping-trolley; in harbour; very-turbid"),
        ("sin rocas, solo tres botellas sobre grava, 30 imágenes", "30 images; 3 bottle; no rock; gravel"),
        ("200 images d'une épave sur de la vase à 25 m, eau trouble", "200 images; 1 shipwreck; mud; 25 m deep; turbid"),
        ("deux tonneaux et trois bouteilles à moitié enfouis dans le sable, 50 images, 8 m de fond", "50 images; 2 barrel (buried 0.5); 3 bottle (buried 0.5); sand; 8 m deep"),
        ("生成50张图像:三个桶半埋在泥里,水深8米,浑浊的水", "50 images; 3 barrel (buried 0.5); mud; 8 m deep; turbid"),
        ("两个锚和一些石头在砂底上,20米深,100帧", "100 images; 2 anchor; 3..5 rock; sand; 20 m deep"),
        ("一艘沉船躺在沙底上,水深30米,200张图片", "200 images; 1 shipwreck (resting); sand; 30 m deep"),
        ("用声呐拍摄一个鱼雷,距离5米,50张图像", "50 images; 1 torpedo; 5 m range"),
        ("Hola", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("20 Bilder eines rostigen Ankers im Hafen, 5 m Tiefe, trübes Wasser", "20 images; 1 anchor; in harbour; 5 m deep; turbid"),
        ("Bitte erstelle 300 Bilder von fünf bis zehn Steinen auf Kies in 20 m Tiefe", "300 images; 5..10 rock; gravel; 20 m deep"),
        ("zwei Dutzend Flaschen auf feinem Sand, 80 Bilder, Tiefe 7 m", "80 images; 24 bottle; fine-sand; 7 m deep"),
        ("Ein Taucher schwebt 2 m über dem Grund, 40 Bilder, Wassertiefe 10 m", "40 images; 1 diver (floating 2); 10 m deep"),
        ("Wrack in 35 m Tiefe, Sonar 4 m über Grund, 120 Bilder", "120 images; ? shipwreck; 35 m deep; 4 m altitude"),
        ("Drei Minen halb im Schlamm vergraben, 60 Bilder, 25 m", "60 images; 3 mine (buried 0.5); mud; 25 m deep"),
        ("Fahrrad lehnt an einer Kaimauer, 30 Bilder", "30 images; ? bicycle (leaning on anything); in pier"),
        ("Sonar Oculus M1200d, 2,1 MHz, maximale Reichweite 8 m, 50 Bilder einer Kiste", "50 images; 1 crate; oculus-m1200d-hf; 2100 kHz; 8 m far"),
        ("keine Reifen, nur zwei Anker auf Sand, 15 Bilder", "15 images; 2 anchor; no tire; sand"),
        ("Süßwasser, 4 m tief, 8 °C, zwei Flaschen, 20 Bilder", "20 images; 2 bottle; 4 m deep; 8 °C; 0 ppt"),
        ("Quiero 200 imágenes de tres botellas y un ancla oxidada sobre fondo rocoso a 15 m", "200 images; 3 bottle; 1 anchor; rock|rough-rock; 15 m deep"),
        ("cien imágenes de un torpedo semienterrado en arena fina, 20 metros de profundidad, agua clara", "100 images; 1 torpedo (buried 0.5); fine-sand; 20 m deep; clear"),
        ("ochenta imágenes de barriles en un lago, agua dulce, profundidad 6 m", "80 images; ? barrel; 6 m deep; 0 ppt"),
        ("un buzo nadando a 2 m sobre el fondo, 50 imágenes", "50 images; 1 diver (floating 2)"),
        ("sonar a 3 m sobre el fondo, 60 imágenes de un naufragio a 40 m", "60 images; 1 shipwreck; 40 m deep; 3 m altitude"),
        ("50 imágenes de rocas y latas sin neumáticos", "50 images; ? rock; ? can; no tire"),
        ("imágenes: 75, dos cajas, fondo de grava, pendiente de 10 grados", "75 images; 2 box; slope; 10° slope; gravel"),
        ("Je voudrais 150 images de trois bouteilles sur du gravier à 12 m", "150 images; 3 bottle; gravel; 12 m deep"),
        ("80 images d'un torpille à moitié enfouie dans le sable, profondeur 18 m, eau claire", "80 images; 1 torpedo (buried 0.5); sand; 18 m deep; clear"),
        ("une ancre rouillée et deux tonneaux dans un port, 5 m de profondeur, 60 images", "60 images; 1 anchor; 2 barrel; in harbour; 5 m deep"),
        ("sonar à 4 m au-dessus du fond, 90 images d'une épave à 30 m", "90 images; 1 shipwreck; 30 m deep; 4 m altitude"),
        ("vingt images de quatre pneus sur fond rocheux, sans rochers", "20 images; 4 tire; no rock; rock|rough-rock"),
        ("100张图像,五个瓶子和一个箱子,泥底,水深6米", "100 images; 5 bottle; 1 box; mud; 6 m deep"),
        ("生成200张声呐图像:两艘沉船,沙底,深度30米,清澈的水", "200 images; 2 shipwreck; sand; 30 m deep; clear"),
        ("潜水员在海底上方2米游泳,50张图像", "50 images; ? diver (floating 2)"),
        ("港口里的三辆自行车,水很浑浊,水深4米,60张", "60 images; 3 bicycle; in harbour; 4 m deep; very-turbid"),
        ("没有轮胎,只有两个锚,20张图像", "20 images; 2 anchor; no tire"),
        ("一个鱼雷半埋在沙里,水深20米,声呐距离5米,80张图像", "80 images; 1 torpedo (buried 0.5); sand; 20 m deep; 5 m range"),
    ]);
}

#[rustfmt::skip]
#[test]
fn what_is_refused() {
    all_are_read_as(&[
        ("What can you do?", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("10 images of an anchor at depth 0 m", "refused: a depth of 0 m: there is no water to see anything in"),
        ("a barrel floating 20 m above the bottom in 10 m of water", "refused: a barrel 20 m above the bottom in water 10 m deep: that is above the surface"),
        ("0 images", "refused: zero images: a dataset has at least one"),
        ("-5 images of a tire", "refused: -5 images: a number of images is not negative, at least 1"),
        ("three to one tires, 10 images", "refused: three to one tires: the range runs backwards, from 3 to 1"),
        ("remove the anchor", "refused: \"remove the\" changes a recipe that is there, and a draft begins a new one"),
        ("make the water clearer", "refused: \"make the\" changes a recipe that is there, and a draft begins a new one"),
        ("3.5 tires on sand", "refused: 3.5 tires: a number of things is whole and at least 0, not 3.5"),
        ("Turn the sonar by 10 degrees", "refused: \"Turn the\" changes a recipe that is there, and a draft begins a new one"),
        ("make the bottom sandy instead of muddy", "refused: \"make the\" changes a recipe that is there, and a draft begins a new one"),
        ("Increase the depth to 20 m", "refused: \"Increase the\" changes a recipe that is there, and a draft begins a new one"),
        ("replace the anchor with a crate", "refused: \"replace the\" changes a recipe that is there, and a draft begins a new one"),
        ("add a diver", "refused: \"add\" changes a recipe that is there, and a draft begins a new one"),
        ("take away one tire", "refused: \"take away\" changes a recipe that is there, and a draft begins a new one"),
        ("Make it darker", "refused: \"Make it\" changes a recipe that is there, and a draft begins a new one"),
        ("make a dataset", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("images", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("1000000 tires", "refused: 1000000 of tire in one scene are more than find room: at most 1000"),
        ("how do I cook pasta", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("SELECT * FROM models", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("rm -rf /", "refused: no object, scene or image of a sonar dataset is spoken of"),
        ("anchor 3 m above the surface", "refused: 3 m above the surface: sonar sees nothing above the surface"),
        ("a sonar at 20 m altitude in 10 m of water, a tire", "refused: a sonar 20 m above the bottom in water 10 m deep: that is above the surface"),
        ("a 30 m ship in a 5 m tank", "refused: a ship of 30 m does not fit into a tank of 5 m"),
        ("a crate at 300 km depth", "refused: a depth of 300000 m is deeper than any sea"),
        ("5-3 barrels", "refused: 5-3 barrels: the range runs backwards, from 5 to 3"),
        ("twenty to ten cans, 5 images", "refused: twenty to ten cans: the range runs backwards, from 20 to 10"),
        ("minus three tires", "refused: minus three tires: a number of things is whole and at least 0, not -3"),
        ("an anchor buried 200 %", "refused: anchor 200 % buried: a thing can be buried from 0 to 100 % of its height"),
        ("5 images of a crate split 80/80/80", "refused: shares of training, validation and test that add up to 240 %"),
    ]);
}

/// Words of the table, numbers and marks in any order, the same in every run.
fn nonsense(seed: u64, count: usize) -> String {
    let words: Vec<&str> = vocabulary().words().collect();
    let others = [
        "12", "0.5", "(", ")", ",", "-", "of", "the", "half", "each", "no", "\u{0}", "锚", "ü", "%", "m", "°", "\"",
        "🦀", "a", "x=", "/",
    ];
    let mut state = seed;
    let mut next = |most: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % most
    };
    let mut text = String::new();
    for _ in 0..count {
        let word = if next(3) == 0 { others[next(others.len())] } else { words[next(words.len())] };
        text += word;
        text += if next(6) == 0 { "" } else { " " };
    }
    text
}

#[test]
fn nothing_panics_and_nothing_hangs() {
    let (_folder, known) = known();
    let mut texts: Vec<String> = (0..80).map(|seed| nonsense(seed, 60)).collect();
    texts.extend((0..3).map(|seed| nonsense(seed + 1000, 900)));
    for word in [
        "a ",
        "the ",
        "each ",
        "no ",
        "10 ",
        "10 and ",
        "(",
        "half of ",
        "a b ",
        "anchor ",
        "x",
        "锚",
        "between ",
        "12 m ",
        "1,",
        "- ",
        "the same ",
    ] {
        texts.push(word.repeat(4000 / word.len()));
    }
    let bytes: Vec<u8> = (0..4000_u32).map(|place| (place.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    texts.push(String::from_utf8_lossy(&bytes).into_owned());
    for text in texts {
        let begin = Instant::now();
        let _ = summary(&text, &known);
        assert!(begin.elapsed() < Duration::from_secs(20), "{text}");
    }
}
