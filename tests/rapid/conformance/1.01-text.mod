!=== comment_to_the_end_of_line
! rule: a comment starts with ! and ends with the line
! source: [K §2.10]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1; ! a := ;;; ENDPROC
        ! IF THEN
    ENDPROC
ENDMODULE
!=== comment_with_tab
! rule: a comment may contain tabs
! source: [K §2.10]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1;	!	b := ;	ENDPROC
        b := a;
        a := b;
    ENDPROC
ENDMODULE
!=== comments_anywhere
! rule: comments may stand behind code and between its parts
! source: [code] abb_driver and 628 more places
! before
MODULE Demo ! behind the name
    RECORD r ! here
        ! a component
        num x;
    ENDRECORD
    PROC main()
        MoveAbsJ ! which
            [[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]], ! how fast
            v100, fine, tool0;
    ENDPROC
ENDMODULE
! behind
!=== keywords_in_any_case
! rule: keywords and names are compared without case
! source: [K §2.3]
module Demo
    Var Num A;
    Proc Main()
        If a = 1 Then
            A := 2;
        EndIf
    EndProc
endmodule
!=== latin1_letters
! rule: accented letters of Latin-1 belong to names
! source: [K §2.1]
MODULE Demo
    VAR num größe;
    VAR num été;
    PROC main()
        größe := 1;
        Été := größe;
    ENDPROC
ENDMODULE
!=== multiplication_sign_is_no_letter
! rule: the signs × and ÷ are no letters
! source: [K §2.1]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a×b := 1;  ! -> RG204
    ENDPROC
ENDMODULE
!=== number_and_name_need_a_blank
! rule: a separator stands between a number and a name
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1b;  ! -> RG205
    ENDPROC
ENDMODULE
!=== number_and_word_touch
! rule: a number ends before a reserved word that goes on with an expression or a statement
! source: [K §2.2] wants a blank; loaded: CommSF.sys of a welding cell, saved twelve times [code]
MODULE Demo
    VAR num a1TO;
    PROC main()
        IF a1TO = 1THEN  ! -> RG205~
            a1TO := 7DIV 2;  ! as the first: reported once
        ENDIF
        FOR i FROM 1TO 3.5DO
            TPWrite "1TO";
        ENDFOR
    ENDPROC
ENDMODULE
!=== other_alphabets
! rule: letters outside Latin-1 are in no name
! source: [K §2.1]
MODULE Demo
    PROC main()
        VAR num αβ;  ! -> RG204
    ENDPROC
ENDMODULE
!=== separators
! rule: space, tab, form feed and newline separate alike
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a
        :=	1        ;
    ENDPROC
ENDMODULE
!=== signs_may_touch
! rule: other tokens may touch
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a:=(1+2)*-3;  ! -> RG212?
        b:=a{1};  ! -> RG318
    ENDPROC
ENDMODULE
!=== unknown_character
! rule: a character without meaning
! source: [K §2.8]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1 # 2;  ! -> RG204
    ENDPROC
ENDMODULE
!=== unseen_character
! rule: invisible characters are reported once, by their number
! source: [K §2.8]
! at 7: RG204
MODULE Demo
    VAR num a;
    PROC main()
        a　:= 1;
        a := a​ + 2;
        ! 　 in comments they do no harm
        TPWrite " ";
    ENDPROC
ENDMODULE
